// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/dense_active_set.h"

#include <Eigen/QR>

namespace scoria::controller {
namespace {

bool Fits(const DenseQpView& qp) noexcept {
  return qp.H.rows() <= DenseQp::kMaxVars && qp.A.rows() <= qp.H.rows() &&
         qp.C.rows() <= DenseQp::kMaxRows;
}

/// Jacobi scaling z = D s: blocks of very different weight then meet in the null space on equal
/// terms. A variable without cost of its own keeps its unit.
DenseQp::Vector Scaling(const DenseQpView& qp) noexcept {
  DenseQp::Vector D = qp.H.diagonal();
  for (double& d : D) d = d > 0.0 ? 1.0 / std::sqrt(d) : 1.0;
  return D;
}

}  // namespace

void DenseActiveSet::Add(const Side& a, double low, double high, Eigen::Index owner) noexcept {
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

/// The inequalities over y, z = z_0 + basis y.
void DenseActiveSet::CollectSides(const DenseQpView& qp, const Square& basis,
                                  const Vector& z_0) noexcept {
  num_sides_ = 0;
  sides_.resize(kMaxSides, basis.cols());
  bounds_.resize(kMaxSides);
  for (Eigen::Index i = 0; i < qp.C.rows(); ++i) {
    const double at_0 = qp.C.row(i).dot(z_0);
    Add(qp.C.row(i) * basis, qp.l[i] - at_0, qp.u[i] - at_0, i);
  }
  for (Eigen::Index i = 0; i < basis.rows(); ++i)
    Add(basis.row(i), qp.lb[i] - z_0[i], qp.ub[i] - z_0[i], qp.C.rows() + i);
  sides_.conservativeResize(num_sides_, Eigen::NoChange);
  bounds_.conservativeResize(num_sides_);
}

void DenseActiveSet::Extract(const DenseQpView& qp, const Square& basis,
                             const Vector& z_0) noexcept {
  solution_.status = result_.status;
  solution_.iterations = result_.iterations;
  solution_.z = z_0 + basis * result_.x;
  solution_.of_rows.setZero(qp.C.rows());
  solution_.of_bounds.setZero(basis.rows());
  if (solution_.status != SolveStatus::kOptimal) return;
  for (Eigen::Index side = 0; side < num_sides_; ++side) {
    const Eigen::Index owner = owner_[static_cast<std::size_t>(side)];
    const double multiplier = sign_[static_cast<std::size_t>(side)] * result_.multipliers[side];
    (owner < qp.C.rows() ? solution_.of_rows[owner] : solution_.of_bounds[owner - qp.C.rows()]) +=
        multiplier;
  }
}

DenseSolutionView DenseActiveSet::Solve(const DenseQpView& qp) noexcept {
  if (!Fits(qp)) {
    solution_ = {};
    solution_.status = SolveStatus::kTooLarge;
    return solution_;
  }
  const Eigen::Index n = qp.H.rows(), equalities = qp.A.rows(), free = n - equalities;
  const Vector D = Scaling(qp);
  const Square At = D.asDiagonal() * qp.A.transpose();
  const Eigen::HouseholderQR<Square> qr(At);
  Square Q = Square::Identity(n, n);
  Q.applyOnTheLeft(qr.householderQ());
  const Square R = qr.matrixQR().topRows(equalities);
  Vector s = qp.b;
  R.transpose().triangularView<Eigen::Lower>().solveInPlace(s);
  const Vector z_0 = D.asDiagonal() * (Q.leftCols(equalities) * s);
  const Square basis = D.asDiagonal() * Q.rightCols(free);  // z = z_0 + basis y
  CollectSides(qp, basis, z_0);

  const Square HB = qp.H * basis;
  const Square G = basis.transpose() * HB;
  const Vector slope = qp.g + qp.H * z_0;
  const Vector g = basis.transpose() * slope;
  solver_.Solve(G, g, sides_, bounds_, result_);
  Extract(qp, basis, z_0);
  return solution_;
}

}  // namespace scoria::controller
