// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/dense_qp.h"

#include <Eigen/QR>

namespace scoria::controller {
namespace {

using Side = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, DenseQp::kMaxVars>;

/// Jacobi scaling z = D s: blocks of very different weight then meet in the null space on equal
/// terms. A variable without cost of its own keeps its unit.
DenseQp::Vector Scaling(const DenseQp::Square& H) noexcept {
  DenseQp::Vector D = H.diagonal();
  for (double& d : D) d = d > 0.0 ? 1.0 / std::sqrt(d) : 1.0;
  return D;
}

}  // namespace

void DenseQpSolver::Add(const Side& a, double low, double high, Eigen::Index owner) noexcept {
  if (low > -DenseQp::kNone) {
    owner_[static_cast<std::size_t>(num_sides_)] = owner;
    sign_[static_cast<std::size_t>(num_sides_)] = -1.0;
    sides_.row(num_sides_) = a;
    bounds_[num_sides_++] = low;
  }
  if (high < DenseQp::kNone) {
    owner_[static_cast<std::size_t>(num_sides_)] = owner;
    sign_[static_cast<std::size_t>(num_sides_)] = 1.0;
    sides_.row(num_sides_) = -a;
    bounds_[num_sides_++] = -high;
  }
}

void DenseQpSolver::Solve(const DenseQp& qp, DenseSolution& out) noexcept {
  using Square = DenseQp::Square;
  using Vector = DenseQp::Vector;
  const Eigen::Index n = qp.H.rows(), equalities = qp.A.rows(), free = n - equalities;
  const Vector D = Scaling(qp.H);
  const Square At = D.asDiagonal() * qp.A.transpose();
  const Eigen::HouseholderQR<Square> qr(At);
  Square Q = Square::Identity(n, n);
  Q.applyOnTheLeft(qr.householderQ());
  const Square R = qr.matrixQR().topRows(equalities);
  Vector s = qp.b;
  R.transpose().triangularView<Eigen::Lower>().solveInPlace(s);
  const Vector z_0 = D.asDiagonal() * (Q.leftCols(equalities) * s);
  const Square basis = D.asDiagonal() * Q.rightCols(free);  // z = z_0 + basis y

  num_sides_ = 0;
  sides_.resize(kMaxSides, free);
  bounds_.resize(kMaxSides);
  for (Eigen::Index i = 0; i < qp.C.rows(); ++i) {
    const double at_0 = qp.C.row(i).dot(z_0);
    Add(qp.C.row(i) * basis, qp.l[i] - at_0, qp.u[i] - at_0, i);
  }
  for (Eigen::Index i = 0; i < n; ++i)
    Add(basis.row(i), qp.lb[i] - z_0[i], qp.ub[i] - z_0[i], qp.C.rows() + i);
  sides_.conservativeResize(num_sides_, Eigen::NoChange);
  bounds_.conservativeResize(num_sides_);

  const Square HB = qp.H * basis;
  const Square G = basis.transpose() * HB;
  const Vector g = basis.transpose() * (qp.g + qp.H * z_0);
  solver_.Solve(G, g, sides_, bounds_, result_);
  out.status = result_.status;
  out.iterations = result_.iterations;
  out.z = z_0 + basis * result_.x;
  out.of_rows.setZero(qp.C.rows());
  out.of_bounds.setZero(n);
  if (out.status != SolveStatus::kOptimal) return;
  for (Eigen::Index side = 0; side < num_sides_; ++side) {
    const Eigen::Index owner = owner_[static_cast<std::size_t>(side)];
    const double multiplier = sign_[static_cast<std::size_t>(side)] * result_.multipliers[side];
    (owner < qp.C.rows() ? out.of_rows[owner] : out.of_bounds[owner - qp.C.rows()]) += multiplier;
  }
}

}  // namespace scoria::controller
