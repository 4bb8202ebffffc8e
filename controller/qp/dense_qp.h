// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include <Eigen/Core>

#include "controller/qp/status.h"

namespace scoria::controller {

/// General dense problem: min ½ zᵀHz + gᵀz  s.t.  A z = b,  l ≤ C z ≤ u,  lb ≤ z ≤ ub. Bounds
/// beyond ±1e19 mean none.
struct DenseQp {
  Eigen::MatrixXd H, A, C;
  Eigen::VectorXd g, b, l, u, lb, ub;
};

struct DenseSolution {
  SolveStatus status = SolveStatus::kNumerical;
  int iterations = 0;
  Eigen::VectorXd z;
};

/// Solves any DenseQp with up to 42 variables: eliminates the equalities by an orthonormal basis of
/// their null space, then runs the dual active set on what is left. For benchmarks and
/// cross-checks; it allocates.
class DenseQpSolver {
 public:
  DenseQpSolver();
  ~DenseQpSolver();
  [[nodiscard]] DenseSolution Solve(const DenseQp& qp);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::controller
