// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/conversions/tsid_dense_form.h"

#include <gtest/gtest.h>

#include "controller/qp/problems/kkt.h"
#include "controller/qp/solvers/dense_active_set.h"
#include "controller/qp/solvers/tsid_nullspace.h"
#include "tests/support/qp_problems.h"

namespace scoria::controller {
namespace {

std::vector<TsidLayout> AllLayouts(const TsidProblem& p) {
  std::vector<TsidLayout> layouts;
  for (const TsidVariables variables : {TsidVariables::kReduced, TsidVariables::kFull}) {
    layouts.push_back(TsidLayout::Compact(p, variables));
    layouts.push_back(TsidLayout::OfFile(p.stance, variables));
  }
  return layouts;
}

bool Equal(const DenseQp& a, const DenseQp& b) {
  return a.H == b.H && a.g == b.g && a.A == b.A && a.b == b.b && a.C == b.C && a.l == b.l &&
         a.u == b.u && a.lb == b.lb && a.ub == b.ub;
}

/// Runs `check(problem, layout)` on problems with and without torque limits in every layout.
template <class Check>
void ForSamples(Check&& check) {
  core::Rng rng(21, 0, core::Stream::kSensor);
  for (int trial = 0; trial < 60; ++trial) {
    TsidProblem p = test::SampleTsid(rng, test::SampleStance(trial));
    p.limit_torques = trial % 4 != 3;
    for (const TsidLayout& layout : AllLayouts(p)) check(p, layout);
  }
}

// The null space knows nothing of the dense forms: its solution must be optimal in all of them.
TEST(TsidDenseForm, SolutionMeetsTheConditionsOfEveryForm) {
  int limited = 0;
  ForSamples([&](const TsidProblem& p, const TsidLayout& layout) {
    const TsidSolution s = TsidNullspace().Solve(p);
    ASSERT_EQ(s.status, SolveStatus::kOptimal);
    for (const Leg leg : kLegs) limited += (s.of_tau[leg].array() != 0.0).count();
    DenseQp qp;
    ToDense(p, layout, qp);
    const KktResidual r = CalcKkt(qp, CompletePoint(qp, ToDense(s, layout)));
    EXPECT_TRUE((KktLimits{1e-8, 1e-9, 1e-8, 1e-8}.Hold(r)))
        << r.primal << " " << r.dual << " " << r.stationarity << " " << r.complementarity;
  });
  EXPECT_GT(limited, 50) << "torque limits took part";
}

TEST(TsidDenseForm, DenseSolutionsComeBackAsTheNullSpaceFindsThem) {
  const auto solver = std::make_unique<DenseActiveSet>();
  ForSamples([&](const TsidProblem& p, const TsidLayout& layout) {
    const TsidSolution expected = TsidNullspace().Solve(p);
    DenseQp qp;
    ToDense(p, layout, qp);
    const TsidSolution s = FromDense(solver->Solve(qp), p, layout);
    ASSERT_EQ(s.status, SolveStatus::kOptimal);
    EXPECT_LT((s.a - expected.a).norm(), 1e-6);
    for (const Leg leg : kLegs) {
      EXPECT_LT((s.qdd[leg] - expected.qdd[leg]).norm(), 1e-6);
      EXPECT_LT((s.f[leg] - expected.f[leg]).norm(), 1e-5);
      EXPECT_LT((s.tau[leg] - expected.tau[leg]).norm(), 1e-5);
      EXPECT_LT((s.of_cone[leg] - expected.of_cone[leg]).norm(), 1e-5);
      EXPECT_LT((s.of_tau[leg] - expected.of_tau[leg]).norm(), 1e-5);
    }
  });
}

TEST(TsidDenseForm, BlocksComeBackFromEveryFormThatHoldsTorqueLimits) {
  ForSamples([&](const TsidProblem& p, const TsidLayout& layout) {
    if (!p.limit_torques) return;
    DenseQp qp, again;
    ToDense(p, layout, qp);
    const TsidProblem back = FromDense(qp, layout);
    ToDense(back, layout, again);
    EXPECT_TRUE(Equal(qp, again));
    EXPECT_EQ(back.H_BB, p.H_BB);
    EXPECT_EQ(back.G_ff, p.G_ff);
    EXPECT_EQ(back.h_l, layout.full ? p.h_l : ZeroPerLeg());
  });
}

// As in WBCQPR01 and WBCQPF01 of the reference: no row for the least force, and sides from above.
TEST(TsidDenseForm, ShortConesAndUpperSidesAreRead) {
  core::Rng rng(22, 0, core::Stream::kSensor);
  TsidProblem p = test::SampleTsid(rng, test::SampleStance(2));
  for (auto& low : p.cone_min) low[4] = 0.0;  // the pyramid implies it
  const TsidLayout five = TsidLayout::OfFile(p.stance, TsidVariables::kReduced),
                   four = TsidLayout::OfFile(p.stance, TsidVariables::kReduced, 4);
  DenseQp qp, shorter;
  ToDense(p, five, qp);
  shorter = qp;
  shorter.C.resize(four.rows, four.variables);
  shorter.l.resize(four.rows);
  shorter.u.resize(four.rows);
  shorter.C.topRows(kNumJoints) = qp.C.topRows(kNumJoints);
  shorter.l.head(kNumJoints) = qp.l.head(kNumJoints);
  shorter.u.head(kNumJoints) = qp.u.head(kNumJoints);
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    for (int i = 0; i < 4; ++i) {
      const double sign = i % 2 == 0 ? 1.0 : -1.0;
      const int from = five.cone[leg] + i, to = four.cone[leg] + i;
      shorter.C.row(to) = sign * qp.C.row(from);
      shorter.l[to] = sign > 0.0 ? qp.l[from] : -DenseQp::kUnbounded;
      shorter.u[to] = sign > 0.0 ? DenseQp::kUnbounded : -qp.l[from];
    }
  }
  const TsidSolution expected = TsidNullspace().Solve(p),
                     s = TsidNullspace().Solve(FromDense(shorter, four));
  ASSERT_EQ(s.status, SolveStatus::kOptimal);
  EXPECT_LT((s.a - expected.a).norm(), 1e-8);
  for (const Leg leg : kLegs) EXPECT_LT((s.f[leg] - expected.f[leg]).norm(), 1e-6);
}

}  // namespace
}  // namespace scoria::controller
