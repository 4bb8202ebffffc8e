// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "logs/quality/quality_check.h"
#include "logs/quality/resampler.h"
#include "logs/quality/statistics.h"
#include "logs/quality/tick_history.h"

namespace scoria::logs {

/// Attitudes against the rate of the trunk and against what holds the robot up: the order of a
/// quaternion's numbers, roll and pitch exchanged, signs, the way of turning, the axes of the IMU.
class AttitudeCheck : public QualityCheck {
 public:
  explicit AttitudeCheck(const LogSubject& subject) : subject_(subject) {}
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

  /// What may have been done to an attitude on its way into the log. After these come the axes that
  /// gyroscope and accelerometer may have instead: the 23 ways to turn them by quarters.
  enum class Reading {
    kAsIs,
    kScalarFirstReadLast,
    kScalarLastReadFirst,
    kRollPitchSwapped,
    kInverse,
    kPitchYawSigns,
    kRollSign,
    kPitchSign,
  };
  static constexpr std::size_t kNumAttitudes = 8, kNumReadings = kNumAttitudes + 23;

 private:
  struct Evidence {
    // Cost of the attitude as it is minus that of the reading. Where the truth's own rate has to
    // do, it may have been turned by the same wrong attitude: two ways to see it.
    BlockMean rate, turned_rate, gravity;
    [[nodiscard]] const BlockMean& BestRate() const noexcept;
    [[nodiscard]] double gain() const noexcept;
  };
  void AddSource(std::size_t source);
  [[nodiscard]] std::vector<Finding> JudgeSource(std::size_t source,
                                                 const std::vector<Finding>& earlier) const;

  LogSubject subject_;
  TickHistory<5> last_;
  std::optional<Vec3> up_B_;  // low-passed: by the accelerometer, else by the legs

  std::array<std::array<Evidence, kNumReadings>, kNumMotionSources> evidence_;
};

}  // namespace scoria::logs
