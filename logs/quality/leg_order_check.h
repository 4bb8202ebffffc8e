// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>

#include "logs/quality/leg_tick.h"
#include "logs/quality/quality_check.h"
#include "logs/quality/statistics.h"

namespace scoria::logs {

/// For each leg, which leg's columns hold it.
using LegOrder = std::array<std::size_t, kNumLegs>;
inline constexpr std::size_t kNumLegOrders = 24;
/// All of them; the first is that all legs are in their own.
[[nodiscard]] const std::array<LegOrder, kNumLegOrders>& LegOrders();
/// "FL from FR, FR from FL": the legs that are not in their own columns.
[[nodiscard]] std::string DescribeOrder(const LegOrder& order);

/// The order of the legs: feet that bear load stay where they are while the trunk turns, which
/// moves feet of one end and side apart from those of the other.
class LegOrderCheck : public QualityCheck {
 public:
  explicit LegOrderCheck(const LogSubject& subject) : subject_(subject) {
    if (subject.robot != nullptr) leg_ticks_.emplace(*subject.robot, subject.gravity_mps2);
  }
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  LogSubject subject_;
  std::optional<LegTickMaker> leg_ticks_;      // none without a robot
  std::array<BlockMean, kNumLegOrders> gain_;  // cost of the order as it is, minus that of each
  Moments cost_;
};

}  // namespace scoria::logs
