// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/config/archive.h"
#include "core/robot/description.h"
#include "terrains/heightfield.h"

namespace scoria::app {

/// Walks a closed loop around the tile's centre, planned once on the true map around steps and
/// steep places, as a person would lead the robot. The route depends on the ground and the robot
/// alone, so it is the same for every arm.
struct RouteParams {
  static constexpr const char* kType = "route";
  double speed_mps = 0.3;
  double distance_m = 30.0;
  double loop_radius_m = 8.0;
  double look_ahead_m = 0.8;
  double yaw_gain_per_s = 1.5;
  double max_yaw_rate_radps = 0.6;
  double lag_s = 0.3;
  double max_step_m = 0.12, max_slope_rad = 0.4363;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("speed_mps", speed_mps, {.min = 0.01, .max = 5.0});
    a.Field("distance_m", distance_m, {.min = 0.1, .max = 1e5, .doc = "to walk; the loop repeats"});
    a.Field("loop_radius_m", loop_radius_m, {.min = 1.0, .max = 100.0});
    a.Field("look_ahead_m", look_ahead_m,
            {.min = 0.1, .max = 5.0, .scale = core::dimension::kLength});
    a.Field("yaw_gain_per_s", yaw_gain_per_s,
            {.min = 0.0, .max = 20.0, .scale = core::dimension::kRate});
    a.Field("max_yaw_rate_radps", max_yaw_rate_radps,
            {.min = 0.0, .max = 5.0, .scale = core::dimension::kRate});
    a.Field(
        "lag_s", lag_s,
        {.min = 0.0, .max = 5.0, .doc = "of the operator's hand", .scale = core::dimension::kTime});
    a.Field("max_step_m", max_step_m,
            {.min = 0.01,
             .max = 1.0,
             .doc = "worth a detour ten times as long",
             .scale = core::dimension::kLength});
    a.Field("max_slope_rad", max_slope_rad, {.min = 0.01, .max = 1.5, .doc = "likewise"});
  }
};

/// A closed polyline on the ground.
using Route = std::vector<Vec2>;

/// Cheapest loop through eight places near the circle (A* on a 0.1 m grid). A metre costs
///   1 + 9 ((step / max_step)² + (tan slope / tan max_slope)²)²
/// with the worst place of the robot's corridor: a step is the range of heights within 0.2 m, a
/// slope that under the robot's length. So the lowest crossing of a gully is cheaper than a higher
/// one, and the way round a boulder cheaper than its top.
/// Errors: core::ConfigError where the terrain is too small for a loop.
[[nodiscard]] Route PlanRoute(const RouteParams& params, const core::RobotDescription& robot,
                              const terrains::Heightfield& ground);

}  // namespace scoria::app
