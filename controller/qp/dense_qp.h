// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include <Eigen/Core>

#include "controller/qp/dual_active_set.h"

namespace scoria::controller {

/// General dense problem: min ½ zᵀHz + gᵀz  s.t.  A z = b,  l ≤ C z ≤ u,  lb ≤ z ≤ ub, with at most
/// 42 variables and 64 rows in C. Bounds beyond ±kNone mean none. Fixed storage: no allocation.
struct DenseQp {
  static constexpr int kMaxVars = 42, kMaxRows = 64;
  static constexpr double kNone = 1e19;
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxVars, kMaxVars>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxRows, kMaxVars>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxVars, 1>;
  using RowVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRows, 1>;
  Square H, A;
  Rows C;
  Vector g, b, lb, ub;
  RowVector l, u;
};

struct DenseSolution {
  SolveStatus status = SolveStatus::kNumerical;
  int iterations = 0;
  DenseQp::Vector z;
  // Multipliers: positive at an upper bound, negative at a lower one.
  DenseQp::RowVector of_rows;
  DenseQp::Vector of_bounds;
};

/// Eliminates the equalities by an orthonormal basis of their null space, then runs the dual active
/// set on what is left.
class DenseQpSolver {
 public:
  void Solve(const DenseQp& qp, DenseSolution& out) noexcept;

 private:
  static constexpr int kMaxSides = 2 * (DenseQp::kMaxVars + DenseQp::kMaxRows);
  using Solver = DualActiveSet<DenseQp::kMaxVars, kMaxSides>;

  /// Collects a z ≥ b from two-sided rows, leaving out infinite sides.
  void Add(const Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, DenseQp::kMaxVars>& a,
           double low, double high, Eigen::Index owner) noexcept;

  Eigen::Index num_sides_ = 0;
  Solver::Rows sides_;
  Solver::RowVector bounds_;
  std::array<Eigen::Index, kMaxSides> owner_{};  // row of C, or number of rows + variable
  std::array<double, kMaxSides> sign_{};
  Solver solver_;
  Solver::Result result_;
};

}  // namespace scoria::controller
