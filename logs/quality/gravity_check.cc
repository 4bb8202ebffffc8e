// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/gravity_check.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "logs/quality/leg_load.h"

namespace scoria::logs {

void GravityCheck::AddTick(const Tick& tick) {
  if (subject_.robot != nullptr) {
    const auto force = CalcForceOfFeet(*subject_.robot, tick);
    if (force) legs_B_.Add(*force);
  }
  if (!tick.a_WS_B) return;
  const Vec3& a = *tick.a_WS_B;
  a_B_.Add(a);
  const auto R_WB = AttitudeOf(tick);
  if (!R_WB) return;
  a_W_.Add(*R_WB * a);
  up_B_.Add(R_WB->row(2).transpose());
  for (unsigned signs = 0; signs < signs_.size(); ++signs) {
    Vec3 turned = a;
    for (unsigned i = 0; i < 3; ++i) {
      if ((signs >> i & 1U) != 0) turned[i] = -turned[i];
    }
    signs_[signs].Add((*R_WB * turned - subject_.gravity_mps2 * Vec3::UnitZ()).squaredNorm());
  }
}

Finding GravityCheck::SignFinding(bool attitude_is_reliable,
                                  const std::vector<Finding>& earlier) const {
  Finding f = MakeFinding(Severity::kError, FindingKind::kGravitySign, SignalId::kImuAcceleration);
  f.size = a_B_.mean().z();
  f.evidence = fmt::format("its mean is {:+.2f} m/s2 on z, but by the {} up is {}z of the trunk",
                           a_B_.mean().z(), attitude_is_reliable ? "attitude" : "load of the legs",
                           a_B_.mean().z() < 0.0 ? "+" : "-");
  const auto axes = std::find_if(earlier.begin(), earlier.end(), [](const Finding& e) {
    return e.kind == FindingKind::kAttitudeSign &&
           e.repair.find("imu.acceleration") != std::string::npos;
  });
  if (axes != earlier.end()) {  // the gyroscope tells axes that the accelerometer shares
    f.repair = axes->repair;
    return f;
  }
  const auto rms = [&](unsigned signs) { return std::sqrt(signs_[signs].mean()); };
  constexpr unsigned kZ = 4, kAll = 7;
  if (signs_[kZ].count() > 0)
    f.evidence += fmt::format(
        "; difference from gravity {:.2f} m/s2 rms as it is, {:.2f} with -z, {:.2f} with -x, -y, "
        "-z",
        rms(0), rms(kZ), rms(kAll));
  const bool is_sure =
      signs_[kZ].count() > 0 && std::abs(rms(kZ) - rms(kAll)) > 0.02 * std::min(rms(kZ), rms(kAll));
  const bool z_alone = is_sure && rms(kZ) < rms(kAll);
  f.repair = fmt::format("mapping: imu.acceleration: {{axes: {}}}{}",
                         z_alone ? "[x, y, -z]" : "[-x, -y, -z]",
                         is_sure ? "" : "; not enough motion to tell the signs of x and y");
  return f;
}

std::vector<Finding> GravityCheck::Conclude(const std::vector<Finding>& earlier) const {
  if (a_B_.count < BlockMean::kBlock) return {};
  // Other faults of an attitude leave up where it is while the robot is nearly level.
  const bool attitude_is_wrong =
      HasError(earlier, {FindingKind::kQuaternionOrder, FindingKind::kDegrees});
  const bool has_attitude = a_W_.count >= BlockMean::kBlock && !attitude_is_wrong;
  const Vec3 mean = has_attitude ? a_W_.mean() : a_B_.mean();
  const double size = mean.norm(), share = size / subject_.gravity_mps2;
  const auto finding = [&](Severity severity, FindingKind kind) {
    Finding f = MakeFinding(severity, kind, SignalId::kImuAcceleration);
    f.size = share;
    return f;
  };
  std::vector<Finding> findings;
  if (std::abs(size - 1.0) < 0.15 && std::abs(share - 1.0) > kError) {
    Finding f = finding(Severity::kError, FindingKind::kGravityUnit);
    f.evidence = fmt::format("its mean is {:.3f}: it is in g", size);
    f.repair = "mapping: imu.acceleration: {unit: g}";
    findings.push_back(f);
  } else if (share < 0.1) {
    Finding f = finding(Severity::kError, FindingKind::kGravityMissing);
    f.evidence = fmt::format("its mean is {:.3f} m/s2: gravity was taken away", size);
    f.repair = "mapping: imu.acceleration: {gravity: removed}";
    return {f};
  } else if (std::abs(share - 1.0) > kWarning) {
    Finding f = finding(std::abs(share - 1.0) > kError ? Severity::kError : Severity::kWarning,
                        FindingKind::kGravitySize);
    f.evidence = fmt::format("its mean is {:.3f} m/s2, {:.0f} % of gravity; 3 % less is usual",
                             size, 100.0 * share);
    findings.push_back(f);
  }
  const bool has_legs = legs_B_.count >= BlockMean::kBlock;
  if (!has_attitude && !has_legs) return findings;
  const Vec3 up = has_attitude ? up_B_.mean() : legs_B_.mean();
  // Sixty degrees: half way to where a sign can be wrong.
  if (a_B_.mean().normalized().dot(up.normalized()) < -0.5)
    findings.push_back(SignFinding(has_attitude, earlier));
  return findings;
}

}  // namespace scoria::logs
