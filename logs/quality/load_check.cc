// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/load_check.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>
#include <fmt/format.h>

#include "logs/quality/leg_load.h"

namespace scoria::logs {
namespace {

constexpr double kUpShare = 0.5;  // the trunk is up: of the leg's length over the feet

/// How far the trunk is above its lowest two feet, m.
double HeightOverFeet(const core::WholeBody& wb) {
  std::array<double, kNumLegs> depths{};
  std::size_t i = 0;
  for (const Vec3& p : wb.p_BF_W) depths[i++] = -p.z();
  std::sort(depths.begin(), depths.end());
  return 0.5 * (depths[2] + depths[3]);
}

}  // namespace

LoadCheck::LoadCheck(const LogSubject& subject) : subject_(subject) {
  if (subject.robot != nullptr) model_.emplace(*subject.robot, subject.gravity_mps2);
}

void LoadCheck::AddTick(const Tick& tick) {
  if (!model_ || !tick.q || !tick.tau) return;
  RobotState state;
  state.q = *tick.q;
  if (const auto R_WB = AttitudeOf(tick)) state.R_WB = *R_WB;
  core::WholeBody wb;
  model_->Calc(state, wb);
  const double length_m = LegLength(subject_.robot->legs[Leg::kFL]);
  if (HeightOverFeet(wb) < kUpShare * length_m) return;
  const double scale = length_m * length_m * length_m / 8.0;
  double sum_fz = 0.0;
  for (const Leg leg : kLegs) {
    const Mat3& J = wb.J_ll[leg];
    if (std::abs(J.determinant()) < kLeastDeterminant * scale) return;
    sum_fz += (J.transpose().inverse() * (wb.h_l[leg] - (*tick.tau)[leg])).z();
  }
  force_.Add(sum_fz);
}

std::optional<Finding> LoadCheck::MassFinding() const {
  if (force_.count() < 6 * BlockMean::kBlock) return std::nullopt;
  const double mass_kg = force_.mean() / subject_.gravity_mps2;
  const double expected_kg = subject_.robot->total_mass_kg(), share = mass_kg / expected_kg;
  Finding f = MakeFinding(Severity::kError, FindingKind::kTorqueScale, SignalId::kJointTau);
  f.size = share;
  f.evidence = fmt::format("torques bear {:.2f} kg, the robot has {:.2f} kg", mass_kg, expected_kg);
  if (share < 0.0) {
    f.kind = FindingKind::kTorqueSign;
    f.evidence += ": they pull it down";
    f.repair = "mapping: joints.tau: {scale: -1}";
    return f;
  }
  f.evidence +=
      fmt::format(": a scale of {:.2f}, or a payload of {:+.2f} kg", share, mass_kg - expected_kg);
  f.repair = fmt::format("mapping: joints.tau: {{scale: {:.3f}}}, or another robot", 1.0 / share);
  if (std::abs(share - 1.0) < kWarning) return std::nullopt;
  if (share < kErrorAbove && share > kErrorBelow) f.severity = Severity::kWarning;
  if (share < kScaleAbove && share > kScaleBelow) f.kind = FindingKind::kMass;
  return f;
}

std::vector<Finding> LoadCheck::Conclude(const std::vector<Finding>& earlier) const {
  if (!model_ || HasError(earlier, {FindingKind::kDegrees, FindingKind::kQuaternionOrder,
                                    FindingKind::kAttitudeSign, FindingKind::kJointSign,
                                    FindingKind::kLegOrder, FindingKind::kJointOffset,
                                    FindingKind::kJointOrder, FindingKind::kTorqueSign}))
    return {};
  std::vector<Finding> findings;
  if (const auto f = MassFinding()) findings.push_back(*f);
  return findings;
}

}  // namespace scoria::logs
