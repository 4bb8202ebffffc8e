// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

#include "core/config/archive.h"
#include "core/robot/state.h"
#include "terrains/heightfield.h"

namespace scoria::app {

struct VelocityStep {
  double at_s = 0.0, v_x_mps = 0.0, v_y_mps = 0.0, w_z_radps = 0.0;
  GaitPattern pattern = GaitPattern::kOwn;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("at_s", at_s, {.min = 0.0, .doc = "since the robot stands"});
    a.Field("v_x_mps", v_x_mps, {.min = -5.0, .max = 5.0});
    a.Field("v_y_mps", v_y_mps, {.min = -5.0, .max = 5.0});
    a.Field("w_z_radps", w_z_radps, {.min = -5.0, .max = 5.0});
    a.Field("pattern", pattern, {.doc = "phase offsets to walk with, in place of the gait's own"});
  }
};

/// Commands velocities by the clock.
struct VelocityProgramme {
  static constexpr const char* kType = "velocity";
  std::vector<VelocityStep> steps;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("steps", steps, {.doc = "each holds until the next"});
  }
};

/// Walks a closed loop around the tile's centre, planned once on the true map around steps and
/// steep places, as a person would lead the robot. The same ground gives the same route to every
/// arm.
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
    a.Field("look_ahead_m", look_ahead_m, {.min = 0.1, .max = 5.0});
    a.Field("yaw_gain_per_s", yaw_gain_per_s, {.min = 0.0, .max = 20.0});
    a.Field("max_yaw_rate_radps", max_yaw_rate_radps, {.min = 0.0, .max = 5.0});
    a.Field("lag_s", lag_s, {.min = 0.0, .max = 5.0, .doc = "of the operator's hand"});
    a.Field("max_step_m", max_step_m, {.min = 0.01, .max = 1.0, .doc = "to be led around"});
    a.Field("max_slope_rad", max_slope_rad, {.min = 0.01, .max = 1.5});
  }
};

using OperatorParams = std::variant<VelocityProgramme, RouteParams>;

/// A closed polyline on the ground.
using Route = std::vector<Vec2>;

/// Shortest loop through eight points of the circle that pays twentyfold for cells with steps or
/// slopes beyond the limits and their surroundings (A* on a 0.2 m grid).
[[nodiscard]] Route PlanRoute(const RouteParams& params, const terrains::Heightfield& ground);

/// The person with the remote control.
class Operator {
 public:
  Operator(const OperatorParams& params, const terrains::Heightfield& ground);

  /// @param time_s since the walking controller took over, standing included. @param dt_s since the
  /// last call.
  [[nodiscard]] Command Update(const RobotState& state, double time_s, double dt_s) noexcept;

  /// Where the robot starts and looks.
  [[nodiscard]] Vec2 start_W() const noexcept;
  [[nodiscard]] double start_yaw_rad() const noexcept;
  [[nodiscard]] const Route& route() const noexcept { return route_; }
  /// Heading of the route near a point; the start heading without a route.
  [[nodiscard]] double HeadingAt(const Vec2& p_W) const noexcept;

 private:
  [[nodiscard]] Command FollowRoute(const RouteParams& params, const RobotState& state,
                                    double dt_s) noexcept;

  OperatorParams params_;
  Route route_;
  std::size_t progress_ = 0;
  Command hand_;  // after the lag
};

}  // namespace scoria::app
