// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "logs/quality/tick.h"

namespace scoria::logs {

/// Distance of the ticks that checks by physics see: short against a stride, long against noise.
inline constexpr double kTick_s = 0.005;

/// Makes evenly spaced ticks of samples that come as they come, by interpolation.
class Resampler {
 public:
  /// Over a longer pause of the log, and where its time goes back, ticks begin anew.
  static constexpr double kLongestPause_s = 0.05;

  explicit Resampler(std::function<void(const Tick&)> on_tick);

  /// @param interrupts  the sample is no continuation: the robot was placed elsewhere.
  void Add(const Tick& sample, bool interrupts);

 private:
  std::function<void(const Tick&)> on_tick_;
  std::optional<Tick> last_;
  double next_s_ = 0.0;
  bool is_first_ = true;
};

}  // namespace scoria::logs
