// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/rate_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/math/angles.h"
#include "core/math/so3.h"

namespace scoria::logs {
namespace {

constexpr double kLimitSlack_rad = 0.2;
constexpr double kLeastRate_radps = 0.1;  // deviation of a rate that tells something
constexpr double kSureCorrelation = 0.6;

/// Whether a factor is one of another unit's, and not an error of some per cent.
bool IsNear(double factor, double expected) {
  return factor > 0.75 * expected && factor < 1.33 * expected;
}

Finding DegreesFinding(SignalId signal, const std::string& evidence) {
  Finding f = MakeFinding(Severity::kError, FindingKind::kDegrees, signal);
  f.size = core::kDegreesPerRad;
  f.evidence = evidence;
  f.repair = fmt::format(
      "mapping: {}: {{unit: {}}}", f.signal,
      signal == SignalId::kJointQd || signal == SignalId::kImuRate || signal == SignalId::kTruthRate
          ? "deg/s"
          : "deg");
  return f;
}

}  // namespace

void RateCheck::AddTick(const Tick& tick) {
  if (tick.q) AddAngles(*tick.q);
  if (tick.w_WB_B) has_gyro_ = true;
  last_.Add(tick);
  if (!last_.IsFull()) return;
  AddJointRates();
  AddTrunkRates();
}

void RateCheck::AddAngles(const LegArray<Vec3>& q) {
  for (const Leg leg : kLegs) {
    for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
      double lower = -2.0 * std::numbers::pi, upper = 2.0 * std::numbers::pi;
      if (subject_.robot != nullptr) {
        const core::JointDescription& joint = subject_.robot->legs[leg].joints[j];
        lower = joint.lower_rad - kLimitSlack_rad;
        upper = joint.upper_rad + kLimitSlack_rad;
      }
      const double angle = q[leg][static_cast<Eigen::Index>(j)];
      ++angles_;
      if (angle < lower || angle > upper) ++beyond_as_rad_;
      if (angle < lower * core::kDegreesPerRad || angle > upper * core::kDegreesPerRad)
        ++beyond_as_degrees_;
    }
  }
}

void RateCheck::AddJointRates() {
  const Tick &begin = last_[0], &mid = last_[2], &end = last_[4];
  if (!begin.q || !end.q || !mid.qd) return;
  constexpr double kSpan_s = 4.0 * kTick_s;
  const auto q0 = Flatten(*begin.q), q1 = Flatten(*end.q), qd = Flatten(*mid.qd);
  for (std::size_t i = 0; i < joints_.size(); ++i) joints_[i].Add((q1[i] - q0[i]) / kSpan_s, qd[i]);
}

void RateCheck::AddTrunkRates() {
  const Tick &begin = last_[0], &mid = last_[2], &end = last_[4];
  const auto& rate = mid.w_WB_B ? mid.w_WB_B : mid.w_true;  // sizes do not depend on axes
  if (!rate) return;
  for (std::size_t s = 0; s < kNumMotionSources; ++s) {
    if (!begin.rpy_rad[s] || !end.rpy_rad[s]) continue;
    const Vec3 turned = *end.rpy_rad[s] - *begin.rpy_rad[s];
    if (turned.norm() > 3.0) continue;  // an angle turned over
    trunk_[s].Add(turned.norm() / (4.0 * kTick_s), rate->norm());
  }
}

bool RateCheck::AnglesAreInDegrees() const {
  const auto share = [&](std::uint64_t n) {
    return static_cast<double>(n) / static_cast<double>(angles_);
  };
  return angles_ > 0 && share(beyond_as_rad_) > 0.3 && share(beyond_as_degrees_) < 0.05;
}

std::vector<Finding> RateCheck::JointFindings(const std::vector<Finding>& earlier) const {
  std::vector<Finding> findings;
  const bool in_degrees = AnglesAreInDegrees();
  int fast = 0, slow = 0, alike = 0;
  for (const PairMoments& joint : joints_) {
    if (joint.deviation_x() < kLeastRate_radps && joint.deviation_y() < kLeastRate_radps) continue;
    const double factor = std::abs(joint.slope());
    fast += IsNear(factor, core::kDegreesPerRad) ? 1 : 0;
    slow += IsNear(factor, 1.0 / core::kDegreesPerRad) ? 1 : 0;
    alike += IsNear(factor, 1.0) ? 1 : 0;
  }
  const bool rates_in_degrees = fast > kNumJoints / 2 || (in_degrees && alike > kNumJoints / 2);
  if (in_degrees) {
    findings.push_back(DegreesFinding(
        SignalId::kJointQ,
        fmt::format(
            "{:.0f} % of the angles are beyond what the joints can turn, and none as degrees",
            100.0 * static_cast<double>(beyond_as_rad_) / static_cast<double>(angles_))));
  } else if (slow > kNumJoints / 2) {
    findings.push_back(
        DegreesFinding(SignalId::kJointQ, "angles change 57 times faster than rates tell"));
  }
  if (rates_in_degrees)
    findings.push_back(DegreesFinding(
        SignalId::kJointQd, "rates are 57 times the derivative of the angles in radians"));
  return findings.empty() ? FactorFindings(earlier) : findings;
}

std::vector<Finding> RateCheck::FactorFindings(const std::vector<Finding>& earlier) const {
  std::vector<Finding> findings;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const PairMoments& joint = joints_[i];
    const Leg leg = kLegs[i / kJointsPerLeg];
    const auto j = static_cast<Joint>(i % kJointsPerLeg);
    const bool is_stuck = std::any_of(earlier.begin(), earlier.end(), [&](const Finding& f) {
      return f.kind == FindingKind::kStuckSensor && f.leg == leg && f.joint == j;
    });
    if (is_stuck || joint.deviation_x() < kLeastRate_radps) continue;
    const double r = joint.correlation(), factor = std::abs(joint.slope());
    const bool is_sign = r < -kSureCorrelation,
               is_wrong = std::abs(r) < 0.3 || factor < 0.5 || factor > 2.0;
    if (!is_sign && !is_wrong) continue;
    Finding f = MakeFinding(is_sign || factor > 2.0 ? Severity::kError : Severity::kWarning,
                            FindingKind::kJointRate, SignalId::kJointQd);
    f.leg = leg;
    f.joint = j;
    f.size = joint.slope();
    f.evidence =
        fmt::format("the rate is {:+.2f} times the derivative of the angle, correlation {:+.2f}",
                    joint.slope(), r);
    if (is_sign) f.repair = "mapping: joints.qd: the other sign for this joint";
    findings.push_back(f);
  }
  return findings;
}

std::vector<Finding> RateCheck::TrunkFindings() const {
  std::vector<Finding> findings;
  const SignalId rate = has_gyro_ ? SignalId::kImuRate : SignalId::kTruthRate;
  int slow = 0;
  for (std::size_t s = 0; s < trunk_.size(); ++s) {
    const PairMoments& t = trunk_[s];
    if (t.count() < BlockMean::kBlock) continue;
    const double factor = t.slope();
    if (t.correlation() < kSureCorrelation) continue;
    if (IsNear(factor, 1.0 / core::kDegreesPerRad)) {
      findings.push_back(DegreesFinding(
          kAttitudeSignals[s], fmt::format("the attitude turns {:.1f} times faster than {} says",
                                           1.0 / factor, TraitsOf(rate).key)));
    } else if (IsNear(factor, core::kDegreesPerRad) && slow++ == 0) {
      findings.push_back(
          DegreesFinding(rate, fmt::format("the rate is {:.1f} times that of {}", factor,
                                           TraitsOf(kAttitudeSignals[s]).key)));
    }
  }
  return findings;
}

std::vector<Finding> RateCheck::Conclude(const std::vector<Finding>& earlier) const {
  std::vector<Finding> findings = JointFindings(earlier);
  const std::vector<Finding> trunk = TrunkFindings();
  findings.insert(findings.end(), trunk.begin(), trunk.end());
  return findings;
}

}  // namespace scoria::logs
