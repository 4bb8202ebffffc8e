// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "logs/quality/quality_check.h"
#include "logs/quality/resampler.h"
#include "logs/quality/statistics.h"
#include "logs/quality/tick_history.h"

namespace scoria::logs {

/// Rates against derivatives: of each joint by sign and unit; of the trunk by unit. Angles in
/// degrees by the robot's limits, or by what a joint can turn at all.
class RateCheck : public QualityCheck {
 public:
  explicit RateCheck(const LogSubject& subject) : subject_(subject) {}
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  void AddAngles(const LegArray<Vec3>& q);
  void AddJointRates();
  void AddTrunkRates();
  [[nodiscard]] bool AnglesAreInDegrees() const;
  [[nodiscard]] std::vector<Finding> JointFindings(const std::vector<Finding>& earlier) const;
  /// Joints whose rate is another than the derivative of their angle.
  [[nodiscard]] std::vector<Finding> FactorFindings(const std::vector<Finding>& earlier) const;
  [[nodiscard]] std::vector<Finding> TrunkFindings() const;

  LogSubject subject_;
  TickHistory<5> last_;
  std::uint64_t angles_ = 0, beyond_as_rad_ = 0, beyond_as_degrees_ = 0;
  std::array<PairMoments, kNumJoints> joints_;        // derivative, rate
  std::array<PairMoments, kNumMotionSources> trunk_;  // sizes of the attitude's and the gyro's rate
  bool has_gyro_ = false;
};

}  // namespace scoria::logs
