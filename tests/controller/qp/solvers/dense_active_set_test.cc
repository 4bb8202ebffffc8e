// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/dense_active_set.h"

#include <gtest/gtest.h>

#include "controller/qp/problems/kkt.h"
#include "core/rng.h"

namespace scoria::controller {
namespace {

/// Random, feasible: bounds and rows lie around a point that meets the equalities.
DenseQp SampleDense(core::Rng& rng, int variables, int equalities, int rows) {
  const auto fill = [&](auto& m, int r, int c) {
    m.resize(r, c);
    for (double& v : m.reshaped()) v = rng.NextNormal();
  };
  DenseQp qp;
  fill(qp.H, variables, variables);
  qp.H = (qp.H * qp.H.transpose()).eval();
  qp.H.diagonal().array() += 0.1;
  fill(qp.g, variables, 1);
  fill(qp.A, equalities, variables);
  fill(qp.C, rows, variables);
  DenseQp::Vector inside;
  fill(inside, variables, 1);
  qp.b = qp.A * inside;
  const DenseQp::RowVector at = qp.C * inside;
  qp.l = at.array() - 0.2;
  qp.u = at.array() + 0.2;
  qp.lb = inside.array() - 0.5;
  qp.ub = inside.array() + 0.5;
  for (int i = 0; i < rows; i += 3) qp.l[i] = -DenseQp::kUnbounded;
  for (int i = 0; i < variables; i += 2) qp.ub[i] = DenseQp::kUnbounded;
  return qp;
}

TEST(DenseActiveSet, RandomProblemsMeetTheirOptimalityConditions) {
  core::Rng rng(41, 0, core::Stream::kSensor);
  const auto solver = std::make_unique<DenseActiveSet>();
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 2 + trial % 30;
    const DenseQp qp = SampleDense(rng, n, trial % 3 == 0 ? 0 : n / 3, trial % 20);
    const DenseSolutionView s = solver->Solve(qp);
    ASSERT_EQ(s.status, SolveStatus::kOptimal) << trial;
    EXPECT_TRUE((KktLimits{1e-8, 0.0, 1e-8, 1e-8}.Hold(CalcKkt(qp, CompletePoint(qp, s)))))
        << trial;
  }
}

TEST(DenseActiveSet, ConflictingRowsAreInfeasible) {
  core::Rng rng(42, 0, core::Stream::kSensor);
  DenseQp qp = SampleDense(rng, 3, 0, 2);
  qp.C.row(1) = qp.C.row(0);
  qp.l << -DenseQp::kUnbounded, 1.0;
  qp.u << 0.0, DenseQp::kUnbounded;
  EXPECT_EQ(DenseActiveSet().Solve(qp).status, SolveStatus::kInfeasible);
}

// A view has no size limit, the solver has.
TEST(DenseActiveSet, RefusesWhatExceedsItsMemory) {
  core::Rng rng(43, 0, core::Stream::kSensor);
  const DenseQp small = SampleDense(rng, 3, 0, 0);
  constexpr int kMany = DenseQp::kMaxVars + 1;
  const Eigen::MatrixXd H = Eigen::MatrixXd::Identity(kMany, kMany), none(0, kMany);
  const Eigen::VectorXd g = Eigen::VectorXd::Ones(kMany);
  const Eigen::VectorXd low = -g;
  const DenseQpView large{H, none, none, g, g.head(0), g.head(0), g.head(0), low, g};
  DenseActiveSet solver;
  EXPECT_EQ(solver.Solve(small).status, SolveStatus::kOptimal);
  const DenseSolutionView refused = solver.Solve(large);
  EXPECT_EQ(refused.status, SolveStatus::kTooLarge);
  EXPECT_EQ(refused.z.size(), 0);
}

}  // namespace
}  // namespace scoria::controller
