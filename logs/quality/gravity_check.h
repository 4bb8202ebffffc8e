// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "logs/quality/quality_check.h"
#include "logs/quality/statistics.h"

namespace scoria::logs {

/// The accelerometer against gravity: its mean over a walk is the force that holds the robot up,
/// per mass. Size, unit, sign; the direction is that of the attitude, and of the legs' load.
class GravityCheck : public QualityCheck {
 public:
  /// Real accelerometers are 3 % low; from here on it is a warning, and an error.
  static constexpr double kWarning = 0.06, kError = 0.15;

  explicit GravityCheck(const LogSubject& subject) : subject_(subject) {}
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  /// A mean direction, as sums of x, y, z.
  struct Direction {
    Vec3 sum = Vec3::Zero();
    std::uint64_t count = 0;
    void Add(const Vec3& v) { sum += v, ++count; }
    [[nodiscard]] Vec3 mean() const { return count > 0 ? Vec3(sum / double(count)) : sum; }
  };
  [[nodiscard]] Finding SignFinding(bool attitude_is_reliable,
                                    const std::vector<Finding>& earlier) const;

  LogSubject subject_;
  Direction a_B_, a_W_, legs_B_, up_B_;  // acceleration; feet's force; up by the attitude
  /// Mean squared difference from gravity for each choice of signs of x, y, z: bit i set is minus.
  std::array<Moments, 8> signs_;
};

}  // namespace scoria::logs
