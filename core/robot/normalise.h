// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/robot/description.h"

namespace scoria::core {

/// Turns every joint into the canonical joint convention, whatever sign and zero its URDF gave it:
/// HAA about +x, HFE and KFE about +y, and q = 0 where the leg hangs straight down. A zero that is
/// off by less than 0.05 rad is the maker's own and stays.
/// @returns what makes that impossible, empty if nothing.
[[nodiscard]] std::string NormaliseJoints(RobotDescription& robot);

/// Fills what the robot's YAML left open: nominal height, stance, lying pose, leg length.
void DeriveDefaults(RobotDescription& robot);

/// -1 where the knee bends backwards, as in the house's standing pose, +1 where its limits allow
/// only forwards.
[[nodiscard]] double KneeWay(const LegDescription& leg);

/// The robot's lying pose for one leg, within its limits.
[[nodiscard]] Vec3 LyingPose(const RobotDescription& robot, Leg leg);

/// Mean place of the HAA joints in the root link.
[[nodiscard]] Vec3 MiddleOfHips(const RobotDescription& robot);

/// Thigh and shank, m: HFE to KFE, KFE to foot.
[[nodiscard]] double ThighLength(const LegDescription& leg);
[[nodiscard]] double ShankLength(const LegDescription& leg);
[[nodiscard]] double LegLength(const LegDescription& leg);

}  // namespace scoria::core
