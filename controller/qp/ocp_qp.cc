// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/ocp_qp.h"

namespace scoria::controller {

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
