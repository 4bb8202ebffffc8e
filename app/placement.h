// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "terrains/heightfield.h"

namespace scoria::app {

/// The robot on its four feet, as a person sets it down: the trunk along the ground, each foot on
/// it.
/// @param p_W where the trunk is to be.
[[nodiscard]] RobotState PlaceStanding(const core::RobotDescription& robot,
                                       const terrains::Heightfield& ground, const Vec2& p_W,
                                       double yaw_rad);

/// The robot folded on the ground, level.
[[nodiscard]] RobotState PlaceLying(const core::RobotDescription& robot,
                                    const terrains::Heightfield& ground, const Vec2& p_W,
                                    double yaw_rad);

}  // namespace scoria::app
