// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/problems/ocp_qp.h"

#include <algorithm>

namespace scoria::controller {

Vec6 CalcForceLimits(const OcpQp& qp, const Vec3& f) noexcept {
  const double reach = qp.friction * f.z();
  Vec6 limits;
  limits << f.x() - reach, -f.x() - reach, f.y() - reach, -f.y() - reach, qp.f_min_N - f.z(),
      f.z() - qp.f_max_N;
  return limits;
}

double CalcViolation(const OcpQp& qp, const std::array<Vec12, kMaxHorizon>& u) noexcept {
  double worst = 0.0;
  for (int i = 0; i < qp.horizon; ++i) {
    const auto k = static_cast<std::size_t>(i);
    for (const Leg leg : kLegs) {
      const Vec3 f = u[k].segment<3>(3 * static_cast<int>(leg));
      const bool stance = qp.stages[k].stance[leg];
      worst =
          std::max(worst, stance ? CalcForceLimits(qp, f).maxCoeff() : f.lpNorm<Eigen::Infinity>());
    }
  }
  return worst;
}

double CalcObjective(const OcpQp& qp, const std::array<Vec12, kMaxHorizon>& u) noexcept {
  double objective = 0.0;
  Vec12 x = qp.x0;
  for (int k = 0; k <= qp.horizon; ++k) {
    const OcpStage& stage = qp.stages[static_cast<std::size_t>(k)];
    objective += 0.5 * x.dot(stage.Q.cwiseProduct(x)) + stage.q.dot(x);
    if (k == qp.horizon) break;
    const Vec12& uk = u[static_cast<std::size_t>(k)];
    objective += 0.5 * uk.dot(stage.R.cwiseProduct(uk)) + stage.r.dot(uk);
    x = stage.Drift(x) + stage.B * uk + stage.b;
  }
  return objective;
}

double CalcTrackingOffset(const OcpQp& qp) noexcept {
  double offset = 0.0;
  for (int k = 0; k <= qp.horizon; ++k) {
    const OcpStage& stage = qp.stages[static_cast<std::size_t>(k)];
    for (int i = 0; i < 12; ++i) {
      if (stage.Q[i] > 0.0) offset += 0.5 * stage.q[i] * stage.q[i] / stage.Q[i];
    }
  }
  return offset;
}

}  // namespace scoria::controller
