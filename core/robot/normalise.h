// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/robot/description.h"
#include "core/robot/knees.h"

namespace scoria::core {

/// Turns every joint into the canonical joint convention, whatever sign and zero its URDF gave it:
/// HAA about +x, HFE and KFE about +y, and q = 0 where the leg hangs straight down. A zero that is
/// off by less than 0.05 rad is the maker's own and stays.
/// @returns what makes that impossible, empty if nothing.
[[nodiscard]] std::string NormaliseJoints(RobotDescription& robot);

/// Fills what the robot's YAML left open: nominal height, stance, lying pose, leg length.
void DeriveDefaults(RobotDescription& robot);

/// The robot's lying pose for one leg, within its limits.
[[nodiscard]] Vec3 LyingPose(const RobotDescription& robot, Leg leg);

/// Thigh and shank, m: HFE to KFE, KFE to foot.
[[nodiscard]] double ThighLength(const LegDescription& leg);
[[nodiscard]] double ShankLength(const LegDescription& leg);
[[nodiscard]] double LegLength(const LegDescription& leg);

}  // namespace scoria::core
