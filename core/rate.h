// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace scoria::core {

/// Steps between two samples of a signal of this rate. 1 for an infinite rate: every step.
/// @returns nothing where that is no whole number: the signal would come at another rate.
[[nodiscard]] std::optional<int> StepsBetween(double rate_Hz, double step_s) noexcept;

/// "300 Hz is no whole number of steps of 1 ms; the nearest rates are 333.3 and 250 Hz", or empty.
[[nodiscard]] std::string RateProblem(double rate_Hz, double step_s);

/// Tells in which steps a signal comes: in the first, then every so many.
class RateDivider {
 public:
  /// Errors: std::invalid_argument with RateProblem.
  RateDivider(double rate_Hz, double step_s);

  /// One step. @returns whether the signal comes in it.
  [[nodiscard]] bool Tick() noexcept {
    const bool due = wait_ == 0;
    wait_ = (due ? every_steps_ : wait_) - 1;
    return due;
  }
  /// The next step is the first again.
  void Reset() noexcept { wait_ = 0; }
  [[nodiscard]] int every_steps() const noexcept { return every_steps_; }
  [[nodiscard]] double interval_s() const noexcept { return interval_s_; }

 private:
  int every_steps_;
  double interval_s_;
  int wait_ = 0;  // steps until the next sample
};

}  // namespace scoria::core
