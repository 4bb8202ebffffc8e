// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/foot_order_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

/// Sums of four correlations: what the best order has to be better by.
constexpr double kLeastMargin = 0.5, kSureOrder_t = 3.0;
constexpr double kLeastSpread = 0.05;  // deviation of a leg's load in a block, of the weight

}  // namespace

void FootOrderCheck::AddTick(const Tick& tick) {
  if (subject_.robot == nullptr || !tick.q || !tick.tau || !tick.foot_force) return;
  const Vec3 up_B =
      AttitudeOf(tick) ? Vec3(AttitudeOf(tick)->row(2).transpose()) : Vec3(Vec3::UnitZ());
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) {
    const core::LegDescription& description = subject_.robot->legs[kLegs[leg]];
    const auto force = CalcFootForce(core::CalcLegKinematics(description, (*tick.q)[kLegs[leg]]),
                                     (*tick.tau)[kLegs[leg]], LegLength(description));
    if (!force) continue;
    for (std::size_t sensor = 0; sensor < kNumLegs; ++sensor) {
      all_[leg][sensor].Add(force->dot(up_B), (*tick.foot_force)[sensor]);
      block_[leg][sensor].Add(force->dot(up_B), (*tick.foot_force)[sensor]);
    }
  }
  if (block_[0][0].count() >= kBlock) EndBlock();
}

double FootOrderCheck::Score(const Pairs& pairs, const LegOrder& order) {
  double sum = 0.0;
  for (std::size_t leg = 0; leg < kNumLegs; ++leg) sum += pairs[leg][order[leg]].correlation();
  return sum;
}

void FootOrderCheck::EndBlock() {
  double load_N = 0.0;
  for (const auto& leg : block_) load_N += leg[0].deviation_x() / kNumLegs;
  const double weight_N = subject_.robot->total_mass_kg() * subject_.gravity_mps2;
  if (load_N > kLeastSpread * weight_N) {  // the robot walks
    const double as_is = Score(block_, LegOrders()[0]);
    for (std::size_t i = 0; i < gain_.size(); ++i)
      gain_[i].Add(Score(block_, LegOrders()[i]) - as_is);
  }
  block_ = {};
}

std::vector<Finding> FootOrderCheck::Conclude(const std::vector<Finding>& earlier) const {
  if (all_[0][0].count() == 0 ||
      HasError(earlier, {FindingKind::kDegrees, FindingKind::kJointSign, FindingKind::kJointOffset,
                         FindingKind::kJointOrder, FindingKind::kLegOrder}))
    return {};
  std::array<double, kNumLegOrders> scores{};
  for (std::size_t i = 0; i < scores.size(); ++i) scores[i] = Score(all_, LegOrders()[i]);
  const auto best =
      static_cast<std::size_t>(std::max_element(scores.begin(), scores.end()) - scores.begin());
  double second = -4.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    if (i != best) second = std::max(second, scores[i]);
  }
  const Moments& gain = gain_[best];
  const double error =
      gain.deviation() / std::sqrt(static_cast<double>(std::max<std::uint64_t>(gain.count(), 1)));
  const bool is_sure = gain.count() >= 3 && gain.mean() > kSureOrder_t * error;
  const std::string scores_text = fmt::format(
      "correlations with the load of the legs sum to {:.2f}, {:.2f} as it is, {:.2f} of the next "
      "best",
      scores[best], scores[0], second);
  if (best != 0 && scores[best] - scores[0] > kLeastMargin && is_sure) {
    Finding f = MakeFinding(Severity::kError, FindingKind::kFootSensorOrder, SignalId::kFootForce);
    f.size = scores[best] - scores[0];
    f.evidence = fmt::format("sensors are {}: {}", DescribeOrder(LegOrders()[best]), scores_text);
    f.repair = "mapping: feet.force: {fields: [FL, FR, HL, HR in that order]}";
    return {f};
  }
  if (best != 0 || scores[0] - second < 0.1) {
    Finding f = MakeFinding(Severity::kNote, FindingKind::kNotJudged, SignalId::kFootForce);
    f.spoils.reset();
    f.evidence = fmt::format("order of the sensors: not enough motion to tell; {}", scores_text);
    return {f};
  }
  return {};
}

}  // namespace scoria::logs
