// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/qp_solvers.h"

#include <gtest/gtest.h>

#include "controller/qp/conversions/tsid_dense_form.h"
#include "controller/qp/problems/kkt.h"
#include "tests/support/qp_problems.h"

namespace scoria::controller {
namespace {

// What a solver must do to be listed.
TEST(QpSolvers, EachSolvesRandomProblemsOfItsKind) {
  core::Rng rng(51, 0, core::Stream::kSensor);
  QpSolvers solvers = MakeQpSolvers();
  ASSERT_FALSE(solvers.ocp.empty() || solvers.tsid.empty() || solvers.dense.empty());
  for (int trial = 0; trial < 20; ++trial) {
    const OcpQp ocp = test::SampleOcp(rng, trial % 2 == 0);
    for (auto& [name, solver] : solvers.ocp) {
      solver->Reset();
      const OcpSolution& s = solver->Solve(ocp);
      EXPECT_EQ(s.status, SolveStatus::kOptimal) << name;
      EXPECT_TRUE(kInteriorPointLimits.Hold(CalcKkt(ocp, CompletePoint(ocp, s)))) << name;
    }
    const TsidProblem tsid = test::SampleTsid(rng, test::SampleStance(trial));
    const TsidLayout layout = TsidLayout::OfFile(tsid.stance, TsidVariables::kFull);
    const KktLimits limits{1e-8, 1e-9, 1e-8, 1e-8};
    DenseQp dense;
    ToDense(tsid, layout, dense);
    for (auto& [name, solver] : solvers.tsid) {
      const TsidSolution s = solver->Solve(tsid);
      EXPECT_EQ(s.status, SolveStatus::kOptimal) << name;
      EXPECT_TRUE(limits.Hold(CalcKkt(dense, CompletePoint(dense, ToDense(s, layout))))) << name;
    }
    for (auto& [name, solver] : solvers.dense) {
      const DenseSolutionView s = solver->Solve(dense);
      EXPECT_EQ(s.status, SolveStatus::kOptimal) << name;
      EXPECT_TRUE(limits.Hold(CalcKkt(dense, CompletePoint(dense, s)))) << name;
    }
  }
}

}  // namespace
}  // namespace scoria::controller
