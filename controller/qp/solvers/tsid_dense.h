// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/conversions/tsid_layout.h"
#include "controller/qp/solvers/dense_active_set.h"
#include "controller/qp/solvers/tsid_solver.h"

namespace scoria::controller {

/// The problem as it stands, put to a dense solver with equalities. Slower than the null-space
/// form, and indifferent to stretched legs.
class TsidDense final : public TsidSolver {
 public:
  explicit TsidDense(TsidVariables variables) noexcept : variables_(variables) {}
  [[nodiscard]] TsidSolution Solve(const TsidProblem& problem) noexcept override;

 private:
  TsidVariables variables_;
  DenseQp qp_;
  DenseActiveSet solver_;
};

}  // namespace scoria::controller
