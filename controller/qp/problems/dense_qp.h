// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "controller/qp/status.h"

namespace scoria::controller {

/// General dense problem of any size, wherever it is stored; what solvers and tools take. Borrowed.
///   min ½ zᵀHz + gᵀz  s.t.  A z = b,  l ≤ C z ≤ u,  lb ≤ z ≤ ub; bounds beyond ±1e19 mean none.
struct DenseQpView {
  using Matrix = Eigen::Ref<const Eigen::MatrixXd>;
  using Vector = Eigen::Ref<const Eigen::VectorXd>;
  Matrix H, A, C;
  Vector g, b, l, u, lb, ub;
};

/// Solution of a dense problem, wherever it is stored. Borrowed.
struct DenseSolutionView {
  using Vector = Eigen::Map<const Eigen::VectorXd>;
  SolveStatus status = SolveStatus::kNumerical;
  int iterations = 0;
  Vector z;
  // Multipliers: positive at an upper bound, negative at a lower one.
  Vector of_rows, of_bounds;
};

/// A dense problem with at most 42 variables and 64 rows in C. Fixed storage: no allocation.
struct DenseQp {
  static constexpr int kMaxVars = 42, kMaxRows = 64;
  static constexpr double kNone = 1e19;
  static constexpr double kUnbounded = 1e20;  // what stands where there is no bound
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxVars, kMaxVars>;
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxRows, kMaxVars>;
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxVars, 1>;
  using RowVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxRows, 1>;
  Square H, A;
  Rows C;
  Vector g, b, lb, ub;
  RowVector l, u;
  operator DenseQpView() const noexcept { return {H, A, C, g, b, l, u, lb, ub}; }
};

struct DenseSolution {
  SolveStatus status = SolveStatus::kNumerical;
  int iterations = 0;
  DenseQp::Vector z;
  DenseQp::RowVector of_rows;
  DenseQp::Vector of_bounds;
  operator DenseSolutionView() const noexcept {
    return {status,
            iterations,
            {z.data(), z.size()},
            {of_rows.data(), of_rows.size()},
            {of_bounds.data(), of_bounds.size()}};
  }
};

}  // namespace scoria::controller
