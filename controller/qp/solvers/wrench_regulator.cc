// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/wrench_regulator.h"

#include <Eigen/LU>

namespace scoria::controller {
namespace {

/// a b, the sum written out so that columns stay in registers.
template <class Block>
Block Product(const Block& a, const Block& b) noexcept {
  Block c;
  for (int j = 0; j < 6; ++j) {
    c.col(j) = a.col(0) * b(0, j) + a.col(1) * b(1, j) + a.col(2) * b(2, j) + a.col(3) * b(3, j) +
               a.col(4) * b(4, j) + a.col(5) * b(5, j);
  }
  return c;
}

/// a bᵀ.
template <class Block>
Block ProductTransposed(const Block& a, const Block& b) noexcept {
  Block c;
  for (int j = 0; j < 6; ++j) {
    c.col(j) = a.col(0) * b(j, 0) + a.col(1) * b(j, 1) + a.col(2) * b(j, 2) + a.col(3) * b(j, 3) +
               a.col(4) * b(j, 4) + a.col(5) * b(j, 5);
  }
  return c;
}

template <class Block>
Block Transposed(const Block& a) noexcept {
  Block c = Block::Zero();
  c.template topRows<6>() = a.template topRows<6>().transpose();
  return c;
}

/// a b as an expression, which must be used before a and b end: g++ 12 copies a returned column in
/// halves, and reading it back as a whole then waits for both.
template <class Block, class Column>
EIGEN_ALWAYS_INLINE auto Times(const Block& a, const Column& b) noexcept {
  return (a.col(0) * b[0] + a.col(1) * b[1] + a.col(2) * b[2]) +
         (a.col(3) * b[3] + a.col(4) * b[4] + a.col(5) * b[5]);
}

}  // namespace

/// Symmetric positive definite inverse by 3x3 blocks: two divisions, no square root.
WrenchRegulator::Block WrenchRegulator::Invert(const Block& M) noexcept {
  const Mat3 A_inverse = M.topLeftCorner<3, 3>().inverse();
  const Mat3 C = M.block<3, 3>(3, 0);
  const Mat3 T = C * A_inverse;
  const Mat3 schur = M.block<3, 3>(3, 3) - T * C.transpose();
  const Mat3 schur_inverse = schur.inverse();
  const Mat3 lower = -schur_inverse * T;
  Block out = Block::Zero();
  out.topLeftCorner<3, 3>() = A_inverse - T.transpose() * lower;
  out.block<3, 3>(3, 0) = lower;
  out.block<3, 3>(0, 3) = lower.transpose();
  out.block<3, 3>(3, 3) = schur_inverse;
  return out;
}

void WrenchRegulator::Load(const OcpQp& qp, const FootIndex& feet) noexcept {
  for (int f = 0; f < feet.count; ++f) {
    const auto i = static_cast<std::size_t>(f);
    const Mat12& B = qp.stages[static_cast<std::size_t>(feet.stage[i])].B;
    const int column = 3 * static_cast<int>(feet.leg[i]);
    for (int row = 0; row < 6; ++row) {
      for (int j = 0; j < 3; ++j) B_(f, 3 * row + j) = B(6 + row, column + j);
    }
  }
  horizon_ = qp.horizon;
  const auto pad = [](const auto& v) {
    Column c = Column::Zero();
    c.template head<6>() = v;
    return c;
  };
  for (int k = 0; k < horizon_; ++k) {
    const OcpStage& data = qp.stages[static_cast<std::size_t>(k)];
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    stage.F.setZero();
    stage.F.topLeftCorner<3, 3>() = data.E;
    stage.F.block<3, 3>(3, 3) = data.dt_s * Mat3::Identity();
    stage.Ft = Transposed(stage.F);
    stage.b_1 = pad(data.b.head<6>());
    stage.b_2 = pad(data.b.tail<6>());
    stage.q_1 = pad(data.q.head<6>());
    stage.q_2 = pad(data.q.tail<6>());
  }
  const OcpStage& end = qp.stages[static_cast<std::size_t>(horizon_)];
  q_end_1_ = pad(end.q.head<6>());
  q_end_2_ = pad(end.q.tail<6>());
}

void WrenchRegulator::InvertHessians(const FootIndex& feet, const FootHessian& hessian) noexcept {
  const int n = feet.count;
  const auto a = hessian.a.head(n), b = hessian.b.head(n), d = hessian.d.head(n),
             e = hessian.e.head(n);
  h33_.head(n) = hessian.pivot.head(n).inverse();
  const auto h33 = h33_.head(n);
  h13_.head(n) = -(d / a) * h33;
  h23_.head(n) = -(e / b) * h33;
  h11_.head(n) = a.inverse() - (d / a) * h13_.head(n);
  h22_.head(n) = b.inverse() - (e / b) * h23_.head(n);
  h12_.head(n) = -(d / a) * h23_.head(n);
}

/// S of every stage.
void WrenchRegulator::SumWrenches(const FootIndex& feet) noexcept {
  const int n = feet.count;
  for (int i = 0; i < 6; ++i) {
    const auto x = B_.col(3 * i).head(n), y = B_.col(3 * i + 1).head(n),
               z = B_.col(3 * i + 2).head(n);
    BH_.col(3 * i).head(n) = x * h11_.head(n) + y * h12_.head(n) + z * h13_.head(n);
    BH_.col(3 * i + 1).head(n) = x * h12_.head(n) + y * h22_.head(n) + z * h23_.head(n);
    BH_.col(3 * i + 2).head(n) = x * h13_.head(n) + y * h23_.head(n) + z * h33_.head(n);
    for (int j = 0; j <= i; ++j) {
      BHB_.col(i * (i + 1) / 2 + j).head(n) =
          BH_.col(3 * i).head(n) * B_.col(3 * j).head(n) +
          BH_.col(3 * i + 1).head(n) * B_.col(3 * j + 1).head(n) +
          BH_.col(3 * i + 2).head(n) * B_.col(3 * j + 2).head(n);
    }
  }
  for (int k = 0; k < horizon_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    Block& S = stages_[at].S;
    S.setZero();
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j <= i; ++j) {
        for (int f = feet.first[at]; f < feet.first[at + 1]; ++f)
          S(i, j) += BHB_(f, i * (i + 1) / 2 + j);
        S(j, i) = S(i, j);
      }
    }
  }
}

void WrenchRegulator::Factorize(const OcpQp& qp, const FootIndex& feet,
                                const FootHessian& hessian) noexcept {
  InvertHessians(feet, hessian);
  SumWrenches(feet);
  const Vec12& Q_end = qp.stages[static_cast<std::size_t>(qp.horizon)].Q;
  Block P11 = Block::Zero(), P12 = Block::Zero(), P22 = Block::Zero();
  P11.topRows<6>().diagonal() = Q_end.head<6>();
  P22.topRows<6>().diagonal() = Q_end.tail<6>();
  for (int k = qp.horizon; k-- > 0;) {
    const auto at = static_cast<std::size_t>(k);
    const OcpStage& data = qp.stages[at];
    Stage& stage = stages_[at];
    stage.D = Invert(P22);
    stage.G = Invert(stage.D + stage.S);
    stage.Pb_1 = Times(P11, stage.b_1) + Times(P12, stage.b_2);
    const Block P21 = Transposed(P12);
    stage.Pb_2 = Times(P21, stage.b_1) + Times(P22, stage.b_2);
    stage.Kt = Product(P12, stage.D);
    const Block Xt = Product(stage.Kt, stage.G);
    stage.X = Transposed(Xt);
    P11 += ProductTransposed(Xt, stage.Kt) - ProductTransposed(stage.Kt, P12);
    // Fᵀ(P₁₁F + Xᵀ) + XF + Γ, and the symmetric part of P₁₁ against drift.
    const Block XF = Product(stage.X, stage.F);
    P12 = Product(P11, stage.F) + Xt;
    P22 = Product(stage.Ft, P12) + XF + stage.G;
    P11 = 0.5 * (P11 + Transposed(P11));
    P11.topRows<6>().diagonal() += data.Q.head<6>();
    P22.topRows<6>().diagonal() += data.Q.tail<6>();
  }
}

/// The step of the recursions that is the same for all: forces to wrenches.
void WrenchRegulator::SumGradients(const FootIndex& feet, const FootTable<3>& gradient) noexcept {
  const int n = feet.count;
  const auto g = gradient.topRows(n);
  for (int i = 0; i < 6; ++i) {
    nu_.col(i).head(n) = BH_.col(3 * i).head(n) * g.col(0) + BH_.col(3 * i + 1).head(n) * g.col(1) +
                         BH_.col(3 * i + 2).head(n) * g.col(2);
  }
  for (int k = 0; k < horizon_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    stages_[at].s0.setZero();
    for (int f = feet.first[at]; f < feet.first[at + 1]; ++f)
      stages_[at].s0.head<6>() += nu_.row(f).transpose().matrix();
  }
}

void WrenchRegulator::Solve(const OcpQp& qp, const FootIndex& feet, const FootTable<3>& gradient,
                            FootTrajectory& out) noexcept {
  SumGradients(feet, gradient);
  Column p1 = q_end_1_, p2 = q_end_2_;
  for (int k = horizon_; k-- > 0;) {
    Stage& stage = stages_[static_cast<std::size_t>(k)];
    const Column t2 = p2 + stage.Pb_2;
    const Column c = Times(stage.D, t2) - stage.s0;
    stage.nu0 = Times(stage.G, c);
    const Column wrench_cost = stage.nu0 - t2;
    p1 += stage.Pb_1 + Times(stage.Kt, wrench_cost);
    p2 = stage.nu0 + Times(stage.Ft, p1) + stage.q_2;
    p1 += stage.q_1;
  }
  Column x1 = Column::Zero(), x2 = Column::Zero();
  x1.head<6>() = qp.x0.head<6>();
  x2.head<6>() = qp.x0.tail<6>();
  out.x[0] = qp.x0;
  for (int k = 0; k < horizon_; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Stage& stage = stages_[at];
    x1 += Times(stage.F, x2);
    const Column nu = stage.nu0 + Times(stage.X, x1) + Times(stage.G, x2);
    x1 += stage.b_1;
    x2 += stage.b_2 - stage.s0 - Times(stage.S, nu);
    out.x[at + 1] << x1.head<6>(), x2.head<6>();
    for (int f = feet.first[at]; f < feet.first[at + 1]; ++f) nu_.row(f) = nu.head<6>().transpose();
  }
  CalcForces(feet, gradient, out.u);
}

/// u = −H⁻¹ (g + Bᵀν).
void WrenchRegulator::CalcForces(const FootIndex& feet, const FootTable<3>& gradient,
                                 FootTable<3>& u) const noexcept {
  const int n = feet.count;
  FootTable<3> slope;
  for (int j = 0; j < 3; ++j) {
    const auto B = [&](int i) { return B_.col(3 * i + j).head(n); };
    const auto nu = [&](int i) { return nu_.col(i).head(n); };
    slope.col(j).head(n) = gradient.col(j).head(n) + B(0) * nu(0) + B(1) * nu(1) + B(2) * nu(2) +
                           B(3) * nu(3) + B(4) * nu(4) + B(5) * nu(5);
  }
  const auto x = slope.col(0).head(n), y = slope.col(1).head(n), z = slope.col(2).head(n);
  u.col(0).head(n) = -(h11_.head(n) * x + h12_.head(n) * y + h13_.head(n) * z);
  u.col(1).head(n) = -(h12_.head(n) * x + h22_.head(n) * y + h23_.head(n) * z);
  u.col(2).head(n) = -(h13_.head(n) * x + h23_.head(n) * y + h33_.head(n) * z);
}

}  // namespace scoria::controller
