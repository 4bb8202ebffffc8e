// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/dense_regulator.h"

#include <limits>

#include "core/math/cholesky.h"

namespace scoria::controller {
namespace {

/// [1 F; 0 1]ᵀ M, column by column.
Mat12 DriftTransposed(const OcpStage& stage, const Mat12& M) noexcept {
  Mat12 out = M;
  out.middleRows<3>(6) += stage.E.transpose() * M.topRows<3>();
  out.bottomRows<3>() += stage.dt_s * M.middleRows<3>(3);
  return out;
}

}  // namespace

void DenseRegulator::Factorize(const OcpQp& qp, const FootIndex& feet,
                               const FootHessian& hessian) noexcept {
  Mat12 P = qp.stages[static_cast<std::size_t>(qp.horizon)].Q.asDiagonal();
  for (int k = qp.horizon; k-- > 0;) {
    const auto at = static_cast<std::size_t>(k);
    const OcpStage& data = qp.stages[at];
    Stage& stage = stages_[at];
    stage.B.setZero();
    Mat12 H = Mat12::Identity();
    for (int f = feet.first[at]; f < feet.first[at + 1]; ++f) {
      const int c = 3 * static_cast<int>(feet.leg[static_cast<std::size_t>(f)]);
      stage.B.middleCols<3>(c) = data.B.middleCols<3>(c);
      H.block<3, 3>(c, c) << hessian.a(f), 0.0, hessian.d(f), 0.0, hessian.b(f), hessian.e(f),
          hessian.d(f), hessian.e(f), hessian.c(f);
    }
    const Mat12 PB = P * stage.B;
    const Mat12 PA = DriftTransposed(data, P).transpose();  // P is symmetric
    stage.Pb = P * data.b;
    stage.L = H + stage.B.transpose() * PB;
    stage.Y = stage.B.transpose() * PA;
    if (!core::FactorCholesky<12>(stage.L)) {
      stage.L.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    core::SolveLower<12, 12>(stage.L, stage.Y);
    P = DriftTransposed(data, PA) - stage.Y.transpose() * stage.Y;
    P.diagonal() += data.Q;
  }
}

void DenseRegulator::Solve(const OcpQp& qp, const FootIndex& feet, const FootTable<3>& gradient,
                           FootTrajectory& out) noexcept {
  Vec12 p = qp.stages[static_cast<std::size_t>(qp.horizon)].q;
  for (int k = qp.horizon; k-- > 0;) {
    const auto at = static_cast<std::size_t>(k);
    Stage& stage = stages_[at];
    const Vec12 t = p + stage.Pb;
    stage.h = stage.B.transpose() * t;
    for (int f = feet.first[at]; f < feet.first[at + 1]; ++f) {
      const int c = 3 * static_cast<int>(feet.leg[static_cast<std::size_t>(f)]);
      stage.h.segment<3>(c) += gradient.row(f).transpose().matrix();
    }
    core::SolveLower<12, 1>(stage.L, stage.h);
    p = qp.stages[at].DriftTransposed(t) + qp.stages[at].q - stage.Y.transpose() * stage.h;
  }
  out.x[0] = qp.x0;
  for (int k = 0; k < qp.horizon; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Stage& stage = stages_[at];
    Vec12 u = -(stage.h + stage.Y * out.x[at]);
    core::SolveLowerTransposed<12>(stage.L, u);
    out.x[at + 1] = qp.stages[at].Drift(out.x[at]) + stage.B * u + qp.stages[at].b;
    for (int f = feet.first[at]; f < feet.first[at + 1]; ++f) {
      const int c = 3 * static_cast<int>(feet.leg[static_cast<std::size_t>(f)]);
      out.u.row(f) = u.segment<3>(c).transpose().array();
    }
  }
}

}  // namespace scoria::controller
