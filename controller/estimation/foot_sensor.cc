// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/foot_sensor.h"

#include <algorithm>
#include <cmath>

namespace scoria::controller {
namespace {

std::size_t Buckets(double window_s, double update_s) noexcept {
  return static_cast<std::size_t>(std::lround(window_s / update_s));
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

WindowExtremum::WindowExtremum(std::size_t buckets, double sign) noexcept
    : buckets_(std::clamp<std::size_t>(buckets, 1, kMaxBuckets)), sign_(sign) {
  signed_.fill(kEmpty);
}

void WindowExtremum::Push(std::optional<double> value) noexcept {
  signed_[next_] = value ? sign_ * *value : kEmpty;
  next_ = (next_ + 1) % buckets_;
}

std::optional<double> WindowExtremum::value() const noexcept {
  const auto end = signed_.begin() + static_cast<std::ptrdiff_t>(buckets_);
  const double largest = *std::max_element(signed_.begin(), end);
  return largest == kEmpty ? std::nullopt : std::optional(sign_ * largest);
}

FootSensor::FootSensor(const FootSensorParams& params, double step_s) noexcept
    : params_(params),
      bucket_ticks_(std::max(1, static_cast<int>(std::lround(params.update_s / step_s)))),
      least_in_air_(kInfinity),
      largest_(-kInfinity),
      min_(Buckets(params.min_window_s, params.update_s), -1.0),
      max_(Buckets(params.max_window_s, params.update_s), 1.0),
      threshold_(params.initial_threshold_counts) {}

bool FootSensor::Update(double raw_counts, bool in_air) noexcept {
  if (!std::isfinite(raw_counts)) {
    contact_ = false;
    return contact_;
  }
  largest_ = std::max(largest_, raw_counts);
  if (in_air) least_in_air_ = std::min(least_in_air_, raw_counts);
  all_in_air_ = all_in_air_ && in_air;
  if (++ticks_ >= bucket_ticks_) CloseBucket();
  const double side = contact_ ? -params_.hysteresis_counts : params_.hysteresis_counts;
  contact_ = raw_counts > threshold_ + side;
  return contact_;
}

void FootSensor::CloseBucket() noexcept {
  const bool seen_air = std::isfinite(least_in_air_);
  min_.Push(seen_air ? std::optional(least_in_air_) : std::nullopt);
  max_.Push(largest_);
  if (all_in_air_ && seen_air) newest_zero_ = least_in_air_;
  if (const std::optional<double> least = min_.value()) zero_ = least;
  ticks_ = 0;
  least_in_air_ = kInfinity;
  largest_ = -kInfinity;
  all_in_air_ = true;
  if (!zero_) return;
  const double reference =
      std::min(*zero_ + params_.margin_counts, *max_.value() - params_.margin_counts);
  threshold_ =
      std::min(std::max(reference, *zero_ + params_.noise_counts), params_.max_threshold_counts);
}

bool SensorHealth::IsSaturated(const HealthInput& in) const noexcept {
  return in.raw_counts >= params_.saturated_counts;
}

bool SensorHealth::IsStuck(const HealthInput& in) noexcept {
  if (in.raw_counts != frozen_counts_ || IsSaturated(in)) {
    frozen_counts_ = in.raw_counts;
    frozen_s_ = changed_s_ = 0.0;
    return false;
  }
  frozen_s_ += step_s_;
  // Sensor and observer lag differently: what happens within a transition says nothing, neither
  // after the count froze nor before it moves again.
  if (frozen_s_ <= params_.transition_s) {
    frozen_force_N_ = in.force_N;
  } else if (std::abs(in.force_N - frozen_force_N_) > params_.stuck_force_N) {
    changed_s_ += step_s_;
  }
  return frozen_s_ > params_.stuck_s && changed_s_ > params_.transition_s;
}

bool SensorHealth::HasDrifted(const HealthInput& in) noexcept {
  if (!in.zero_counts) return false;
  if (!first_zero_) first_zero_ = in.zero_counts;
  return std::abs(*in.zero_counts - *first_zero_) > params_.drift_counts;
}

bool SensorHealth::SurelyDown(const HealthInput& in) const noexcept {
  return in.observer && in.probability > params_.sure;
}

bool SensorHealth::SurelyUp(const HealthInput& in) const noexcept {
  return !in.observer && in.probability < 1.0 - params_.sure;
}

bool SensorHealth::Disagrees(const HealthInput& in) noexcept {
  const bool in_transition = since_observer_s_ <= params_.transition_s;
  const bool flying = in.foot_speed_mps > params_.moving_mps;
  const bool disagrees = in.sensor ? SurelyUp(in) || flying : SurelyDown(in) && !flying;
  if (!in_transition && disagrees) {
    disagreement_s_ += step_s_;
  } else if (in.sensor == in.observer) {
    disagreement_s_ = std::max(0.0, disagreement_s_ - params_.forgive * step_s_);
  }
  return disagreement_s_ > params_.disagree_s;
}

bool SensorHealth::Mismatches(const HealthInput& in) noexcept {
  const bool settled = since_observer_s_ > params_.transition_s;
  // A sensor that is not believed must read again as it did.
  const bool learn = healthy_ && !IsSaturated(in);
  return !match_.Update(
      {in.raw_counts, in.force_N, settled && SurelyUp(in), settled && SurelyDown(in), learn});
}

void SensorHealth::TrackTransitions(const HealthInput& in) noexcept {
  const double before_s = since_observer_s_;
  since_sensor_s_ = in.sensor == sensor_ ? since_sensor_s_ + step_s_ : 0.0;
  since_observer_s_ = in.observer == observer_ ? since_observer_s_ + step_s_ : 0.0;
  sensor_ = in.sensor;
  observer_ = in.observer;
  // Judged once, when the observer has been of one mind for transition_s: the sensor must have
  // changed with it, not have been right all along.
  const bool due = before_s <= params_.transition_s && since_observer_s_ > params_.transition_s;
  if (!due) return;
  const bool told = in.sensor == in.observer && since_sensor_s_ < 2.0 * params_.transition_s;
  transitions_ = told ? transitions_ + 1 : 0;
}

bool SensorHealth::Update(const HealthInput& in) noexcept {
  if (!std::isfinite(in.raw_counts)) {
    healthy_ = false;
    faultless_s_ = 0.0;
    transitions_ = 0;
    return healthy_;
  }
  TrackTransitions(in);
  const bool stuck = IsStuck(in);
  const bool drifted = HasDrifted(in);
  const bool disagrees = Disagrees(in);
  const bool mismatches = Mismatches(in);
  if (stuck || drifted || disagrees || mismatches) {
    healthy_ = false;
    faultless_s_ = 0.0;
    transitions_ = 0;
    disagreement_s_ = std::min(disagreement_s_, params_.disagree_s + step_s_);
    return healthy_;
  }
  faultless_s_ += step_s_;
  if (!healthy_ && faultless_s_ >= params_.recover_s &&
      transitions_ >= params_.recover_transitions) {
    healthy_ = true;
    disagreement_s_ = 0.0;
  }
  return healthy_;
}

}  // namespace scoria::controller
