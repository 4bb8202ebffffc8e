// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

namespace scoria::core {

/// What timed events go by. One rule for all of them: an event begins in the first step in which
/// the robot has walked for longer than its at_s (or further than its distance_m), so that no fall
/// before it uses it up; from then on it runs in simulated time, which does not wait for a robot
/// that lies.
struct EventClock {
  double walking_s = 0.0;  // in which the operator has commanded
  double walked_m = 0.0;
  double time_s = 0.0;  // simulated
};

/// The course of one timed event.
class EventTimer {
 public:
  /// To be called in every step. @returns true in the step in which the event begins.
  bool BeginAfter(double at_s, const EventClock& now) noexcept {
    if (begun_s_ || now.walking_s <= at_s + kRounding_s) return false;
    begun_s_ = now.time_s - (now.walking_s - at_s);
    return true;
  }
  bool BeginBeyond(double distance_m, const EventClock& now) noexcept {
    if (begun_s_ || now.walked_m <= distance_m) return false;
    begun_s_ = now.time_s;
    return true;
  }
  /// In simulated time; nothing before it has begun.
  [[nodiscard]] const std::optional<double>& begun_s() const noexcept { return begun_s_; }
  /// Whether it runs, for an event of this duration.
  [[nodiscard]] bool Runs(double duration_s, const EventClock& now) const noexcept {
    return begun_s_ && now.time_s - *begun_s_ <= duration_s + kRounding_s;
  }

 private:
  static constexpr double kRounding_s = 1e-9;  // sums of steps; far below one
  std::optional<double> begun_s_;
};

}  // namespace scoria::core
