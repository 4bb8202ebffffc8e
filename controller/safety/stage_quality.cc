// SPDX-License-Identifier: BSD-3-Clause
#include "controller/safety/stage_quality.h"

#include <algorithm>
#include <cmath>

#include "core/math/low_pass.h"

namespace scoria::controller {
namespace {

bool Swings(const LegPhases& legs, Leg leg) noexcept {
  return legs.mode[leg] == LegMode::kSwing || legs.mode[leg] == LegMode::kStumble;
}

}  // namespace

/// Whether the estimate fits the innovations, and itself: a speed that changes otherwise than the
/// accelerometer says tells a wrong attitude or bias, whatever the covariance admits.
double StageQuality::CalcEstimator(const StageReports& in, double dt_s) noexcept {
  if (!in.estimate_finite || !in.a_W.allFinite()) return 0.0;
  if (in.nis_dof > 0) core::LowPass(nis_ratio_, in.nis / in.nis_dof, params_.nis_window_s, dt_s);
  if (!started_) mean_v_W_ = in.v_W;
  started_ = true;
  const double window_s = params_.acceleration_window_s;
  core::LowPass(mean_v_W_, in.v_W, window_s, dt_s);
  core::LowPass(mean_a_W_, in.a_W, window_s, dt_s);
  const Vec3 by_speed = (in.v_W - mean_v_W_) / window_s;  // low pass of its derivative
  acceleration_residual_W_ = mean_a_W_ - by_speed;
  const double by_acceleration = 1.0 - acceleration_residual_W_.norm() / params_.acceleration_mps2;
  return std::clamp(by_acceleration, 0.0, 1.0 / std::max(1.0, nis_ratio_));
}

double StageQuality::CalcFooting(const StageReports& in, double dt_s) noexcept {
  double stumbles = static_cast<double>(in.slips - slips_);
  slips_ = in.slips;
  for (const Leg leg : kLegs) {
    const bool swings = Swings(in.legs, leg);
    const bool held_up = swings && in.contact[leg] && in.foot_lag_m[leg] > params_.stumble_m;
    if (held_up && !stumbled_[leg]) stumbles += 1.0;
    stumbled_[leg] = swings && (stumbled_[leg] || held_up);
  }
  stumbles_ += stumbles;
  core::LowPass(stumbles_, 0.0, params_.footing_window_s, dt_s);
  const double by_stumbles = 1.0 - stumbles_ / params_.stumbles;
  const double by_tilt = 1.0 - in.tilt_error_rad / params_.tilt_rad;
  return std::max(0.0, std::min(by_stumbles, by_tilt));
}

const Qualities& StageQuality::Update(const StageReports& in, double dt_s) noexcept {
  core::LowPass(answered_, in.body_answered ? 1.0 : 0.0, params_.body_window_s, dt_s);
  const double spare = std::clamp(1.0 - in.torque_shortfall / params_.load_shortfall, 0.0, 1.0);
  core::LowPass(spare_, spare, params_.load_window_s, dt_s);
  const auto set = [&](Monitor monitor, double quality) {
    qualities_[static_cast<std::size_t>(monitor)] = quality;
  };
  set(Monitor::kMpc, std::max(0.0, 1.0 - in.plan_age_share));
  set(Monitor::kBody, answered_);
  set(Monitor::kEstimator, CalcEstimator(in, dt_s));
  set(Monitor::kContact, in.sound_feet_share);
  set(Monitor::kFooting, CalcFooting(in, dt_s));
  set(Monitor::kLoad, spare_);
  return qualities_;
}

}  // namespace scoria::controller
