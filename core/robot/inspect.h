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

}  // namespace scoria::core
