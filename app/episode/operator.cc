// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/operator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/low_pass.h"
#include "core/math/so3.h"

namespace scoria::app {
namespace {

constexpr std::size_t kWindow =
    50;  // points of the route ahead among which the robot is looked for

using Steps = std::vector<VelocityStep>;

/// A programme's heading at a time of the step `now`, before `next` begins: on a line to the
/// heading of that, or as the step commands to turn.
double HeadingDuring(const VelocityStep& now, Steps::const_iterator next, Steps::const_iterator end,
                     double time_s) {
  const double since_s = time_s - now.at_s;
  if (next == end || !next->heading_rad) return *now.heading_rad + since_s * now.w_z_radps;
  return std::lerp(*now.heading_rad, *next->heading_rad, since_s / (next->at_s - now.at_s));
}

}  // namespace

Operator::Operator(const OperatorParams& params, const core::RobotDescription& robot,
                   const terrains::Heightfield& ground)
    : params_(params) {
  if (const auto* route = std::get_if<RouteParams>(&params))
    route_ = PlanRoute(*route, robot, ground);
}

Place Operator::start() const noexcept {
  if (const auto* programme = std::get_if<VelocityProgramme>(&params_))
    return {{programme->start_x_m, programme->start_y_m}, programme->start_yaw_rad};
  return {route_.front(), HeadingAt(0)};
}

/// Near where the robot has come to, so that a route that passes near itself does not send it back
/// or ahead.
std::size_t Operator::NearestOnRoute(const Vec2& p_W) const noexcept {
  constexpr std::size_t kBehind = 20, kAhead = 100;  // points
  const std::size_t size = route_.size(), behind = std::min(kBehind, size - 1);
  std::size_t nearest = progress_;
  for (std::size_t k = 0; k < std::min(behind + kAhead, size); ++k) {
    const std::size_t i = (progress_ + size - behind + k) % size;
    if ((route_[i] - p_W).squaredNorm() < (route_[nearest] - p_W).squaredNorm()) nearest = i;
  }
  return nearest;
}

double Operator::HeadingAt(std::size_t index) const noexcept {
  constexpr std::size_t kAhead = 10;
  const Vec2 along = route_[(index + kAhead) % route_.size()] - route_[index % route_.size()];
  return std::atan2(along.y(), along.x());
}

std::vector<Place> Operator::PlacesAhead(const Place& from, double ahead_m) const {
  constexpr double kAside_m[] = {0.0, 0.15, -0.15, 0.3, -0.3};
  std::vector<Place> places;
  const auto add = [&](const Vec2& p_W, double yaw_rad) {
    for (const double aside_m : kAside_m)
      places.push_back({p_W + aside_m * Vec2(-std::sin(yaw_rad), std::cos(yaw_rad)), yaw_rad});
  };
  if (route_.empty()) {
    constexpr double kRing_m = 0.1, kBeside_m = 0.2, kFurthest_m = 4.0;
    const Vec2 centre = from.p_WB + ahead_m * Vec2(std::cos(from.yaw_rad), std::sin(from.yaw_rad));
    places.push_back({centre, from.yaw_rad});
    for (double radius_m = kRing_m; radius_m < kFurthest_m; radius_m += kRing_m) {
      const int directions =
          std::max(8, static_cast<int>(2.0 * std::numbers::pi * radius_m / kBeside_m));
      for (int k = 0; k < directions; ++k) {
        const double angle = from.yaw_rad + 2.0 * std::numbers::pi * k / directions;
        places.push_back(
            {centre + radius_m * Vec2(std::cos(angle), std::sin(angle)), from.yaw_rad});
      }
    }
    return places;
  }
  constexpr double kFurthest_m = 5.0;
  double along_m = 0.0;
  std::size_t index = NearestOnRoute(from.p_WB);
  for (std::size_t k = 0; k < route_.size() && along_m < ahead_m + kFurthest_m; ++k) {
    if (along_m >= ahead_m) add(route_[index], HeadingAt(index));
    const std::size_t next = (index + 1) % route_.size();
    along_m += (route_[next] - route_[index]).norm();
    index = next;
  }
  return places;
}

/// Pure pursuit: heads for the route point one look-ahead in front.
Command Operator::FollowRoute(const RouteParams& params, const RobotState& state,
                              double dt_s) noexcept {
  const Vec2 p = state.p_WB.head<2>();
  // Only a window ahead is searched, so that a loop that passes near itself is not cut short.
  std::size_t nearest = progress_;
  for (std::size_t k = 0; k < kWindow; ++k) {
    const std::size_t i = (progress_ + k) % route_.size();
    if ((route_[i] - p).squaredNorm() < (route_[nearest] - p).squaredNorm()) nearest = i;
  }
  progress_ = nearest;
  std::size_t target = nearest;
  for (std::size_t k = 0; k < kWindow && (route_[target] - p).norm() < params.look_ahead_m; ++k) {
    target = (target + 1) % route_.size();
  }
  const Vec2 to = route_[target] - p;
  const double yaw = core::RpyFromRotation(state.R_WB).z();
  const double error = core::WrapToPi(std::atan2(to.y(), to.x()) - yaw);
  Command wanted;
  wanted.v_x_mps = params.speed_mps * std::max(0.2, std::cos(error));
  wanted.w_z_radps = std::clamp(params.yaw_gain_per_s * error, -params.max_yaw_rate_radps,
                                params.max_yaw_rate_radps);
  core::LowPass(hand_.v_x_mps, wanted.v_x_mps, params.lag_s, dt_s);
  core::LowPass(hand_.w_z_radps, wanted.w_z_radps, params.lag_s, dt_s);
  return hand_;
}

/// The step that has begun last, and its heading's correction.
Command Operator::FollowProgramme(const VelocityProgramme& programme, const RobotState& state,
                                  double time_s) noexcept {
  const Steps& steps = programme.steps;
  const auto next = std::ranges::upper_bound(steps, time_s, {}, &VelocityStep::at_s);
  if (next == steps.begin()) return {};
  const VelocityStep& now = *std::prev(next);
  Command command;
  command.v_x_mps = now.v_x_mps;
  command.v_y_mps = now.v_y_mps;
  command.w_z_radps = now.w_z_radps;
  command.pattern = now.pattern;
  if (!now.heading_rad || command.IsStop()) return command;
  const double heading_rad = HeadingDuring(now, next, steps.end(), time_s);
  const double yaw_rad = core::RpyFromRotation(state.R_WB).z();
  if (!heading_zero_rad_) heading_zero_rad_ = yaw_rad - heading_rad;
  const double error_rad = core::WrapToPi(*heading_zero_rad_ + heading_rad - yaw_rad);
  command.w_z_radps += std::clamp(programme.yaw_gain_per_s * error_rad,
                                  -programme.max_correction_radps, programme.max_correction_radps);
  return command;
}

Command Operator::Update(const RobotState& state, double time_s, double dt_s) noexcept {
  if (const auto* route = std::get_if<RouteParams>(&params_))
    return FollowRoute(*route, state, dt_s);
  return FollowProgramme(std::get<VelocityProgramme>(params_), state, time_s);
}

}  // namespace scoria::app
