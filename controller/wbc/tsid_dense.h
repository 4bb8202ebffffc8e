// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/dense_qp.h"
#include "controller/wbc/tsid_params.h"
#include "controller/wbc/tsid_problem.h"

namespace scoria::controller {

/// The problem as it stands, over (a, q̈, f of stance feet), and τ with `full`, put to a dense
/// solver with equalities. Slower than the null-space form, and indifferent to stretched legs.
class TsidDense final : public TsidForm {
 public:
  explicit TsidDense(TsidFormulation formulation) noexcept
      : full_(formulation == TsidFormulation::kFull) {}
  [[nodiscard]] TsidSolution Solve(const TsidProblem& problem,
                                   bool torque_limits) noexcept override;

 private:
  void Size(const TsidProblem& p, bool torque_limits) noexcept;
  void AddCost(const TsidProblem& p) noexcept;
  void AddMotion(const TsidProblem& p) noexcept;
  void AddLimits(const TsidProblem& p, bool torque_limits) noexcept;

  bool full_;
  LegArray<int> force_at_;  // first column of each stance foot's force
  int torque_at_ = 0;
  DenseQp qp_;
  DenseQpSolver solver_;
  DenseSolution solution_;
};

}  // namespace scoria::controller
