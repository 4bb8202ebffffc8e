// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urdf_world/types.h>

#include "core/robot/description.h"

namespace scoria::core {

/// Fills bodies, joints, feet, IMU and shapes of a robot that has its config (and the mesh records,
/// where a log carries them) from a URDF's tree, as the URDF has them: links that are fixed to each
/// other merged into the thirteen bodies, joints not yet in the canonical joint convention.
/// Errors: ConfigError that names the URDF, the key or link, and the rule.
void AddUrdfTree(const urdf::ModelInterface& model, RobotDescription& robot);

}  // namespace scoria::core
