// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/plans.h"

#include <algorithm>
#include <cmath>

namespace scoria {

LegArray<Vec3> ForcePlan::ForcesFor(const LegArray<bool>& contact, const Vec3& n_W) const noexcept {
  const auto match = std::find(stance.begin(), stance.end(), contact);
  LegArray<Vec3> f = ZeroPerLeg();
  if (match != stance.end()) {
    const auto& planned = f_F_W[static_cast<std::size_t>(match - stance.begin())];
    for (const Leg leg : kLegs) {
      if (contact[leg]) f[leg] = planned[leg];
    }
    return f;
  }
  double wanted_N = 0.0, sum_N = 0.0;
  for (const Leg leg : kLegs) {
    wanted_N += f_F_W[0][leg].dot(n_W);
    if (!contact[leg]) continue;
    f[leg] = stance[0][leg] ? f_F_W[0][leg] : f_next_F_W[leg];
    sum_N += f[leg].dot(n_W);
  }
  constexpr double kLeast_N = 1.0, kMostScale = 2.0;
  if (sum_N < kLeast_N || wanted_N < kLeast_N) return f;
  for (Vec3& force : f) force *= std::min(kMostScale, wanted_N / sum_N);
  return f;
}

BodyReference::Stage ForcePlan::BodyAfter(double ahead_s) const noexcept {
  const double at = std::clamp(ahead_s / dt_s, 0.0, kStages - 1.001);
  const auto k = static_cast<std::size_t>(at);
  const double s = at - static_cast<double>(k);
  const auto mix = [s](const Vec3& a, const Vec3& b) { return Vec3(a + s * (b - a)); };
  const BodyReference::Stage &a = body[k], &b = body[k + 1];
  return {mix(a.rpy_rad, b.rpy_rad), mix(a.p_WC, b.p_WC), mix(a.w_WB, b.w_WB), mix(a.v_WC, b.v_WC)};
}

Mat3 GroundFrame(const Vec3& n_W, double yaw_rad) noexcept {
  const Vec3 heading(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
  Mat3 R;
  R.col(2) = n_W;
  R.col(0) = (heading - heading.dot(n_W) * n_W).normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

}  // namespace scoria
