// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "logs/quality/joint_hypotheses.h"
#include "logs/quality/leg_tick.h"
#include "logs/quality/quality_check.h"
#include "logs/quality/statistics.h"

namespace scoria::logs {

/// Signs, zeros and order of the joints within each leg: of all that may have been done to them,
/// what makes loaded feet behave as feet on the ground do, and keeps the joints in their limits.
class JointCheck : public QualityCheck {
 public:
  explicit JointCheck(const LogSubject& subject);
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

  /// What the best hypotheses of all legs bring, of the cost of a leg.
  [[nodiscard]] double gain() const;

 private:
  struct LegEvidence {
    std::vector<BlockMean> gain;  // by hypothesis: cost of the joints as they are, minus its cost
    Moments cost;                 // as they are
  };
  void AddLeg(Leg leg, const LegTick& tick, const OtherFeet& others);
  [[nodiscard]] double Cost(Leg leg, const JointHypothesis& h, const LegTick& tick,
                            const OtherFeet& others) const;
  [[nodiscard]] std::optional<Finding> JudgeLeg(Leg leg) const;
  [[nodiscard]] std::vector<Finding> Limits() const;

  LogSubject subject_;
  std::optional<LegTickMaker> leg_ticks_;  // none without a robot
  std::array<LegEvidence, kNumLegs> legs_;
  std::array<double, kNumJoints> furthest_rad_{};  // beyond the limits
  std::array<std::uint64_t, kNumJoints> beyond_{};
  std::uint64_t ticks_ = 0;
};

}  // namespace scoria::logs
