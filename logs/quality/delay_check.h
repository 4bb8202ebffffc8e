// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "logs/quality/quality_check.h"
#include "logs/quality/resampler.h"
#include "logs/quality/statistics.h"
#include "logs/quality/tick_history.h"

namespace scoria::logs {

/// Which of gyroscope and attitude comes later, by their cross-correlation.
class DelayCheck : public QualityCheck {
 public:
  static constexpr double kLargest_s = 0.1;
  /// Filters of sensors take some milliseconds. From the second on it is an error.
  static constexpr double kWarning_s = 0.008, kError_s = 0.015;

  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  static constexpr int kLags = static_cast<int>(kLargest_s / kTick_s + 0.5);  // each way
  static constexpr int kHalf = 4;  // ticks: rates are means over twice that, against noise
  static constexpr std::size_t kNumLags = 2 * kLags + 1;
  struct Bank {
    std::array<BlockMean, kNumLags> gain;    // squared difference without delay, minus that with it
    std::array<double, kNumLags> squares{};  // sums of squared differences
  };
  [[nodiscard]] std::vector<Finding> JudgeSource(std::size_t source) const;

  TickHistory<2 * (kLags + kHalf) + 1> last_;
  std::array<Bank, kNumMotionSources> banks_;
  Moments rate_squares_;
};

}  // namespace scoria::logs
