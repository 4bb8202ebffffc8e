// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/solvers/dual_active_set.h"
#include "controller/qp/solvers/tsid_solver.h"

namespace scoria::controller {

/// Eliminates the equations of motion and the contacts, which leaves always twelve unknowns, z =
/// force of each stance foot or joint acceleration of each swing leg, and no equalities. Needs the
/// inverse of every stance leg's Jacobian: ends with singular_leg where one is nearly
/// stretched.
class TsidNullspace final : public TsidSolver {
 public:
  [[nodiscard]] TsidSolution Solve(const TsidProblem& problem) noexcept override;

 private:
  static constexpr int kVars = 12;
  static constexpr int kMaxRows = kNumLegs * 5 + 2 * kNumJoints;
  using Solver = DualActiveSet<kVars, kMaxRows, kVars>;
  using Mat36 = TsidProblem::Mat36;
  using Mat3x12 = Eigen::Matrix<double, 3, 12>;

  [[nodiscard]] bool Reduce(const TsidProblem& p) noexcept;
  void ReduceCost(const TsidProblem& p) noexcept;
  void BuildRows(const TsidProblem& p) noexcept;

  Eigen::Matrix<double, 6, 12> T_;  // a = T z + t
  Vec6 t_ = Vec6::Zero();
  LegArray<Mat36> K_;  // stance: q̈ = k − K a
  LegArray<Vec3> k_;
  LegArray<Mat3x12> tau_;  // τ = tau z + tau_0
  LegArray<Vec3> tau_0_;
  Mat12 G_;
  Vec12 g_;
  Solver::Rows A_;
  Solver::RowVector b_;
  Solver solver_;
  Solver::Result result_;
};

}  // namespace scoria::controller
