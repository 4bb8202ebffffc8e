// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "controller/qp/solvers/dense_solver.h"
#include "controller/qp/solvers/dual_active_set.h"

namespace scoria::controller {

/// Eliminates the equalities by an orthonormal basis of their null space, then runs the dual active
/// set on what is left. Takes problems of the size of a DenseQp; owns its memory: no allocation.
class DenseActiveSet final : public DenseSolver {
 public:
  [[nodiscard]] DenseSolutionView Solve(const DenseQpView& qp) noexcept override;

 private:
  static constexpr int kMaxSides = 2 * (DenseQp::kMaxVars + DenseQp::kMaxRows);
  using Solver = DualActiveSet<DenseQp::kMaxVars, kMaxSides>;
  using Square = DenseQp::Square;
  using Vector = DenseQp::Vector;
  using Side = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, DenseQp::kMaxVars>;

  /// Collects a z ≥ b from two-sided rows, leaving out infinite sides.
  void Add(const Side& a, double low, double high, Eigen::Index owner) noexcept;
  void CollectSides(const DenseQpView& qp, const Square& basis, const Vector& z_0) noexcept;
  void Extract(const DenseQpView& qp, const Square& basis, const Vector& z_0) noexcept;

  Eigen::Index num_sides_ = 0;
  Solver::Rows sides_;
  Solver::RowVector bounds_;
  std::array<Eigen::Index, kMaxSides> owner_{};  // row of C, or number of rows + variable
  std::array<double, kMaxSides> sign_{};
  Solver solver_;
  Solver::Result result_;
  DenseSolution solution_;
};

}  // namespace scoria::controller
