// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"

namespace scoria::core {

/// Puts the trunk's frame where height, stance and falls need it, if the URDF has it elsewhere: x
/// from the hind to the front hips, z up while the legs hang at the URDF's zero, the origin amidst
/// the hips if it lies further off than a fifth of the leg or not between them. A remark says so.
/// Hips at odds with the names of their legs change nothing; NormaliseJoints names them.
void PlaceTrunkFrame(RobotDescription& robot);

/// Mean place of the HAA joints in the trunk.
[[nodiscard]] Vec3 MiddleOfHips(const RobotDescription& robot);

/// The hip stands in the quarter of the trunk that its leg's name says.
[[nodiscard]] bool IsPlaced(const Vec3& p_BHip, Leg leg);

}  // namespace scoria::core
