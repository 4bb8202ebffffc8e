// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/joint_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace scoria::logs {
namespace {

constexpr double kSlack_rad = 0.15;

/// A gain in cost, of 20 at most, that a hypothesis has to bring; what another one may bring less
/// without being told from it.
constexpr double kLeastJointGain = 0.5, kMargin = 0.25;

bool IsSame(const JointHypothesis& a, const JointHypothesis& b) {
  return a.kind == b.kind && a.joint == b.joint;
}

}  // namespace

JointCheck::JointCheck(const LogSubject& subject) : subject_(subject) {
  if (subject.robot != nullptr) leg_ticks_.emplace(*subject.robot, subject.gravity_mps2);
  for (LegEvidence& leg : legs_) leg.gain.resize(JointHypotheses().size());
}

void JointCheck::AddTick(const Tick& tick) {
  if (subject_.robot == nullptr) return;
  if (tick.q) {
    const auto q = Flatten(*tick.q);
    ++ticks_;
    for (std::size_t i = 0; i < q.size(); ++i) {
      const core::JointDescription& joint =
          subject_.robot->legs[kLegs[i / kJointsPerLeg]].joints[i % kJointsPerLeg];
      const double beyond = std::max(joint.lower_rad - q[i], q[i] - joint.upper_rad);
      furthest_rad_[i] = std::max(furthest_rad_[i], beyond);
      if (beyond > kSlack_rad) ++beyond_[i];
    }
  }
  const std::optional<LegTick> legs = leg_ticks_->Make(tick);
  // A robot that stands or gets up is in few poses, however long it lasts.
  if (!legs || legs->num_loaded == 0 || legs->num_loaded == kNumLegs) return;
  LegArray<FootMotion> feet;
  for (const Leg leg : kLegs)
    feet[leg] = CalcFootMotion(subject_.robot->legs[leg], legs->q[leg], legs->qd[leg],
                               legs->tau[leg], legs->w_WB_B);
  for (const Leg leg : kLegs) {
    if (!legs->loaded[leg]) continue;
    OtherFeet others;
    for (const Leg other : kLegs) {
      if (other != leg && legs->loaded[other]) others.Add(feet[other], legs->up_B);
    }
    AddLeg(leg, *legs, others);
  }
}

double JointCheck::Cost(Leg leg, const JointHypothesis& h, const LegTick& tick,
                        const OtherFeet& others) const {
  const core::LegDescription& description = subject_.robot->legs[leg];
  const Vec3 q = h.UndoAngle(tick.q[leg]);
  const FootMotion foot = CalcFootMotion(description, q, h.UndoRate(tick.qd[leg]),
                                         h.UndoTorque(tick.tau[leg]), tick.w_WB_B);
  return CalcCost(description, q, foot, tick, others, {});
}

void JointCheck::AddLeg(Leg leg, const LegTick& tick, const OtherFeet& others) {
  LegEvidence& evidence = legs_[static_cast<std::size_t>(leg)];
  const auto& hypotheses = JointHypotheses();
  double as_is = 0.0;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    const double cost = Cost(leg, hypotheses[h], tick, others);
    if (h == 0) as_is = cost, evidence.cost.Add(cost);
    evidence.gain[h].Add(as_is - cost);
  }
}

std::optional<Finding> JointCheck::JudgeLeg(Leg leg) const {
  const LegEvidence& evidence = legs_[static_cast<std::size_t>(leg)];
  const auto& hypotheses = JointHypotheses();
  if (evidence.cost.count() < 3 * BlockMean::kBlock) return std::nullopt;
  std::size_t best = 0;
  for (std::size_t h = 1; h < hypotheses.size(); ++h) {
    if (evidence.gain[h].mean() > evidence.gain[best].mean()) best = h;
  }
  const BlockMean& gain = evidence.gain[best];
  if (best == 0 || gain.mean() < kLeastJointGain || gain.t() < kSureAbove_t) return std::nullopt;
  const JointHypothesis& found = hypotheses[best];
  const bool is_torque = found.kind == FindingKind::kTorqueSign;
  Finding f = MakeFinding(Severity::kError, found.kind,
                          is_torque ? SignalId::kJointTau : SignalId::kJointQ);
  f.leg = leg;
  f.joint = found.joint;
  if (found.joint && found.kind == FindingKind::kJointOffset)
    f.size = found.offset_rad[static_cast<Eigen::Index>(*found.joint)];
  f.evidence = fmt::format(
      "with {} its foot, loaded, stays on the ground and bears the robot: cost {:.2f}, not {:.2f}, "
      "{:.0f} standard errors",
      found.Describe(), evidence.cost.mean() - gain.mean(), evidence.cost.mean(),
      std::min(gain.t(), 99.0));
  for (std::size_t h = 1; h < hypotheses.size(); ++h) {
    if (!IsSame(hypotheses[h], found) && gain.mean() - evidence.gain[h].mean() < kMargin)
      f.evidence += fmt::format("; or {} of {}", hypotheses[h].Describe(),
                                hypotheses[h].joint ? static_cast<int>(*hypotheses[h].joint) : -1);
  }
  f.repair = found.Repair();
  return f;
}

std::vector<Finding> JointCheck::Limits() const {
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < beyond_.size(); ++i) {
    const double share = static_cast<double>(beyond_[i]) / static_cast<double>(ticks_);
    if (beyond_[i] == 0 || share < 0.01) continue;
    Finding f = MakeFinding(Severity::kWarning, FindingKind::kJointLimits, SignalId::kJointQ);
    f.leg = kLegs[i / kJointsPerLeg];
    f.joint = static_cast<Joint>(i % kJointsPerLeg);
    f.size = furthest_rad_[i];
    f.evidence =
        fmt::format("it is beyond its limits for {:.0f} % of the time, by {:.2f} rad at most",
                    100.0 * share, furthest_rad_[i]);
    f.repair = "mapping: joints.zero_rad or joints.sign, or another robot";
    findings.push_back(f);
  }
  return findings;
}

double JointCheck::gain() const {
  double sum = 0.0;
  for (const LegEvidence& leg : legs_) {
    double best = 0.0;
    for (const BlockMean& gain : leg.gain) best = std::max(best, gain.mean());
    sum += best;
  }
  return sum / kNumLegs;
}

std::vector<Finding> JointCheck::Conclude(const std::vector<Finding>& earlier) const {
  if (subject_.robot == nullptr || ticks_ == 0) return {};
  if (HasError(earlier, {FindingKind::kDegrees, FindingKind::kQuaternionOrder,
                         FindingKind::kAttitudeSign, FindingKind::kRollPitchSwapped}))
    return {};
  std::vector<Finding> findings;
  for (const Leg leg : kLegs) {
    if (leg_ticks_->IsFarFromEquilibrium()) break;
    if (const auto f = JudgeLeg(leg)) findings.push_back(*f);
  }
  for (const Finding& limit : Limits()) {
    const bool is_explained = std::any_of(findings.begin(), findings.end(), [&](const Finding& f) {
      return f.leg == limit.leg && (!f.joint || f.joint == limit.joint);
    });
    if (!is_explained) findings.push_back(limit);
  }
  return findings;
}

}  // namespace scoria::logs
