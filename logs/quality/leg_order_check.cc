// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/leg_order_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

/// All legs have the same faults here, so that the sizes can be narrower than for one leg.
constexpr CostSizes kSizes = {.floor_mps = 0.05, .share = 0.1, .has_heights = false};
constexpr double kLeastOrderGain = 0.02;

/// Motion of the trunk by each leg's columns, taken for each leg.
using Motions = std::array<std::array<FootMotion, kNumLegs>, kNumLegs>;  // [leg][columns]

/// The mean over loaded legs.
double CostOf(const LegOrder& order, const core::RobotDescription& robot, const Motions& motions,
              const LegTick& tick) {
  double cost = 0.0;
  for (std::size_t leg = 0; leg < order.size(); ++leg) {
    if (!tick.loaded[kLegs[order[leg]]]) continue;
    OtherFeet others;
    for (std::size_t other = 0; other < order.size(); ++other) {
      if (other != leg && tick.loaded[kLegs[order[other]]])
        others.Add(motions[other][order[other]], tick.up_B);
    }
    cost += CalcCost(robot.legs[kLegs[leg]], tick.q[kLegs[order[leg]]], motions[leg][order[leg]],
                     tick, others, kSizes);
  }
  return cost / tick.num_loaded;
}

}  // namespace

const std::array<LegOrder, kNumLegOrders>& LegOrders() {
  static const std::array<LegOrder, kNumLegOrders> kOrders = [] {
    std::array<LegOrder, kNumLegOrders> orders{};
    LegOrder order = {0, 1, 2, 3};
    for (LegOrder& out : orders) {
      out = order;
      std::next_permutation(order.begin(), order.end());
    }
    return orders;
  }();
  return kOrders;
}

std::string DescribeOrder(const LegOrder& order) {
  std::string text;
  for (std::size_t leg = 0; leg < order.size(); ++leg) {
    if (order[leg] == leg) continue;
    text += fmt::format("{}{} from {}", text.empty() ? "" : ", ", LegName(kLegs[leg]),
                        LegName(kLegs[order[leg]]));
  }
  return text.empty() ? "all from their own" : text;
}

void LegOrderCheck::AddTick(const Tick& tick) {
  if (subject_.robot == nullptr) return;
  const std::optional<LegTick> legs = leg_ticks_->Make(tick);
  if (!legs || legs->num_loaded < (legs->v_WB_B ? 1 : 2)) return;
  Motions motions;
  for (std::size_t leg = 0; leg < motions.size(); ++leg) {
    for (std::size_t columns = 0; columns < motions.size(); ++columns) {
      const Leg from = kLegs[columns];
      motions[leg][columns] = CalcFootMotion(subject_.robot->legs[kLegs[leg]], legs->q[from],
                                             legs->qd[from], legs->tau[from], legs->w_WB_B);
    }
  }
  double as_is = 0.0;
  for (std::size_t i = 0; i < gain_.size(); ++i) {
    const double cost = CostOf(LegOrders()[i], *subject_.robot, motions, *legs);
    if (i == 0) as_is = cost, cost_.Add(cost);
    gain_[i].Add(as_is - cost);
  }
}

std::vector<Finding> LegOrderCheck::Conclude(const std::vector<Finding>& earlier) const {
  if (leg_ticks_ && leg_ticks_->IsFarFromEquilibrium()) {
    Finding f = MakeFinding(Severity::kNote, FindingKind::kNotJudged, SignalId::kJointQ);
    f.spoils.reset();
    f.evidence =
        "legs and their joints are not judged: the trunk is far from equilibrium for much of the "
        "time, as in a gait with flight";
    return {f};
  }
  if (cost_.count() < 6 * BlockMean::kBlock) return {};
  if (HasError(earlier,
               {FindingKind::kDegrees, FindingKind::kQuaternionOrder, FindingKind::kAttitudeSign,
                FindingKind::kJointSign, FindingKind::kJointOffset, FindingKind::kJointOrder}))
    return {};
  const auto by_mean = [](const BlockMean& a, const BlockMean& b) { return a.mean() < b.mean(); };
  const auto best = std::max_element(gain_.begin(), gain_.end(), by_mean);
  const LegOrder& order = LegOrders()[static_cast<std::size_t>(best - gain_.begin())];
  if (best != gain_.begin() && best->mean() > kLeastOrderGain && best->t() > kSureAbove_t) {
    Finding f = MakeFinding(Severity::kError, FindingKind::kLegOrder, SignalId::kJointQ);
    f.size = best->mean();
    f.evidence = fmt::format(
        "legs are {}: loaded feet then agree on how the trunk moves (cost {:.3f}, not {:.3f}, "
        "{:.0f} "
        "standard errors)",
        DescribeOrder(order), cost_.mean() - best->mean(), cost_.mean(), std::min(best->t(), 99.0));
    for (std::size_t i = 1; i < gain_.size(); ++i) {
      if (&gain_[i] != &*best && gain_[i].mean() > 0.9 * best->mean())
        f.evidence += fmt::format("; or {}", DescribeOrder(LegOrders()[i]));
    }
    f.repair = "mapping: legs in that order";
    return {f};
  }
  for (std::size_t i = 1; i < gain_.size(); ++i) {
    if (gain_[i].mean() < -kLeastOrderGain / 10.0 && gain_[i].t() < -2.0) continue;
    Finding f = MakeFinding(Severity::kNote, FindingKind::kNotJudged, SignalId::kJointQ);
    f.spoils.reset();
    f.evidence = fmt::format("not enough motion to tell the legs as they are from {}",
                             DescribeOrder(LegOrders()[i]));
    return {f};
  }
  return {};
}

}  // namespace scoria::logs
