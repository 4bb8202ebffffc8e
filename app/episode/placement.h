// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "terrains/heightfield.h"

namespace scoria::app {

/// Where the trunk is to be set down, and which way it looks.
struct Place {
  Vec2 p_WB = Vec2::Zero();  // m
  double yaw_rad = 0.0;
};

/// The robot on its four feet, as a person sets it down: the trunk along the ground, each foot on
/// it.
[[nodiscard]] RobotState PlaceStanding(const core::RobotDescription& robot,
                                       const terrains::Heightfield& ground, const Place& place);

/// The robot folded on the ground, level.
[[nodiscard]] RobotState PlaceLying(const core::RobotDescription& robot,
                                    const terrains::Heightfield& ground, const Place& place);

/// How well the ground carries a robot that was set down: the least of what is left of its limits,
/// as shares of them; above 0 it stands. The limits: friction against the steepest slope that a
/// foot may touch, tilt of the trunk, stretch of the legs, and room below trunk, thighs and shanks.
/// @param standing from PlaceStanding.
[[nodiscard]] double CalcStandingMargin(const core::RobotDescription& robot,
                                        const terrains::Heightfield& ground,
                                        const RobotState& standing);

/// The first place at which the robot stands well; where there is none, the best of them, with a
/// margin of 0 or less.
struct ChosenPlace {
  Place place;
  double margin = 0.0;  // as CalcStandingMargin
};
/// @param places in the order of preference, not empty.
[[nodiscard]] ChosenPlace ChoosePlace(const core::RobotDescription& robot,
                                      const terrains::Heightfield& ground,
                                      std::span<const Place> places);

}  // namespace scoria::app
