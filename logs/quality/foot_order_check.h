// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "logs/quality/leg_order_check.h"
#include "logs/quality/quality_check.h"
#include "logs/quality/statistics.h"

namespace scoria::logs {

/// The order of the foot sensors: each goes with the load that torques tell of its leg.
class FootOrderCheck : public QualityCheck {
 public:
  explicit FootOrderCheck(const LogSubject& subject) : subject_(subject) {}
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  using Pairs = std::array<std::array<PairMoments, kNumLegs>, kNumLegs>;  // [leg][sensor]
  static constexpr std::uint64_t kBlock = 200;                            // ticks: two strides
  void EndBlock();
  [[nodiscard]] static double Score(const Pairs& pairs, const LegOrder& order);

  LogSubject subject_;
  Pairs all_, block_;
  std::array<Moments, kNumLegOrders> gain_;  // of blocks: score of the order minus that as it is
};

}  // namespace scoria::logs
