// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "core/robot/description.h"

namespace scoria::core {

/// What looks wrong about a robot without making it unusable: left and right that are no mirror
/// images, inertias that no body can have, joints without torque, and what the loader had to leave
/// out. One sentence each.
[[nodiscard]] std::vector<std::string> FindSuspicions(const RobotDescription& robot);

/// What changes how a robot walks, or whether it does: collision meshes that are lost or cut,
/// shapes out of proportion to the legs, joints that are held, limits that are placeholders,
/// <dynamics> that are not used. One sentence each, none of FindSuspicions.
[[nodiscard]] std::vector<std::string> FindModelWarnings(const RobotDescription& robot);

}  // namespace scoria::core
