// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "app/episode/placement.h"
#include "app/episode/route.h"
#include "core/config/archive.h"
#include "core/robot/state.h"
#include "terrains/heightfield.h"

namespace scoria::app {

struct VelocityStep {
  double at_s = 0.0, v_x_mps = 0.0, v_y_mps = 0.0, w_z_radps = 0.0;
  GaitPattern pattern = GaitPattern::kOwn;
  std::optional<double> heading_rad = std::nullopt;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("at_s", at_s, {.min = 0.0, .doc = "since the robot stands"});
    a.Field("v_x_mps", v_x_mps, {.min = -5.0, .max = 5.0});
    a.Field("v_y_mps", v_y_mps, {.min = -5.0, .max = 5.0});
    a.Field("w_z_radps", w_z_radps, {.min = -5.0, .max = 5.0});
    a.Field("pattern", pattern, {.doc = "phase offsets to walk with, in place of the gait's own"});
    a.Field("heading_rad", heading_rad,
            {.doc = "at this time, turned since the start and not wrapped: the operator steers to "
                    "it while the robot is to move, on a line to the next step's"});
  }
};

/// Commands velocities by the clock. Where its steps tell a heading the operator steers back to it,
/// as a person does who leads a robot along a way that the ground turns it from.
struct VelocityProgramme {
  static constexpr const char* kType = "velocity";
  std::vector<VelocityStep> steps;
  double yaw_gain_per_s = 1.5;
  double max_correction_radps = 0.6;
  double start_x_m = 0.0, start_y_m = 0.0, start_yaw_rad = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("steps", steps, {.doc = "each holds until the next"});
    a.Field("yaw_gain_per_s", yaw_gain_per_s,
            {.min = 0.0,
             .max = 20.0,
             .doc = "by which headings are steered to",
             .scale = core::dimension::kRate});
    a.Field("max_correction_radps", max_correction_radps,
            {.min = 0.0,
             .max = 5.0,
             .doc = "of the yaw rate, to steer to a heading",
             .scale = core::dimension::kRate});
    a.Field("start_x_m", start_x_m,
            {.doc = "where the robot is set down, or on the nearest ground on which it stands"});
    a.Field("start_y_m", start_y_m);
    a.Field("start_yaw_rad", start_yaw_rad, {.min = -6.2832, .max = 6.2832});
  }
};

using OperatorParams = std::variant<VelocityProgramme, RouteParams>;

/// The person with the remote control.
class Operator {
 public:
  Operator(const OperatorParams& params, const core::RobotDescription& robot,
           const terrains::Heightfield& ground);

  /// @param time_s since the walking controller took over, standing included. @param dt_s since the
  /// last call.
  [[nodiscard]] Command Update(const RobotState& state, double time_s, double dt_s) noexcept;

  /// Where the robot may be set down, in the order of preference: on the route from `from` on,
  /// the nearest first, and beside it; without a route at `from`, and around it.
  /// @param ahead_m along the route (without one: along the heading) that are left out.
  [[nodiscard]] std::vector<Place> PlacesAhead(const Place& from, double ahead_m) const;

  /// Where the robot is to start.
  [[nodiscard]] Place start() const noexcept;
  [[nodiscard]] const Route& route() const noexcept { return route_; }
  /// The robot was set down: the way goes on from there.
  void Resume(const Place& place) noexcept {
    if (!route_.empty()) progress_ = NearestOnRoute(place.p_WB);
    heading_zero_rad_.reset();
  }

 private:
  [[nodiscard]] std::size_t NearestOnRoute(const Vec2& p_W) const noexcept;
  [[nodiscard]] double HeadingAt(std::size_t index) const noexcept;
  [[nodiscard]] Command FollowRoute(const RouteParams& params, const RobotState& state,
                                    double dt_s) noexcept;
  [[nodiscard]] Command FollowProgramme(const VelocityProgramme& programme, const RobotState& state,
                                        double time_s) noexcept;

  OperatorParams params_;
  Route route_;
  std::size_t progress_ = 0;
  Command hand_;                            // after the lag
  std::optional<double> heading_zero_rad_;  // from which a programme's headings count
};

}  // namespace scoria::app
