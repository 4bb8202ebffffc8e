// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/robot/description.h"

namespace scoria::core {

/// Decides which way each knee bends, and puts the limits of the robot's YAML over the URDF's.
/// Where the limits of a KFE allow both ways, `knees` of the YAML decides; without it the bend at
/// the URDF's zero; of the hind legs also whether their shanks are mirror images of the front ones.
/// @pre the joints are in the canonical joint convention.
/// @returns what makes that impossible, empty if nothing.
[[nodiscard]] std::string SettleKneesAndLimits(RobotDescription& robot);

/// -1 where the knee bends backwards, +1 forwards.
[[nodiscard]] inline double KneeWay(const LegDescription& leg) { return leg.knee_way; }

/// The limits of the leg's KFE leave it both ways.
[[nodiscard]] bool BendsEitherWay(const LegDescription& leg);

}  // namespace scoria::core
