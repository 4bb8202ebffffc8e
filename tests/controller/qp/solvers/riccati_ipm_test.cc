// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/riccati_ipm.h"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "controller/qp/solvers/dual_active_set.h"
#include "tests/support/qp_problems.h"

namespace scoria::controller {
namespace {

/// The same problem with the states condensed away, as a dense QP over the stance forces.
double DenseOptimum(const OcpQp& qp) {
  std::vector<std::pair<int, int>> inputs;  // (stage, component)
  for (int k = 0; k < qp.horizon; ++k) {
    for (int i = 0; i < 12; ++i) {
      if (qp.stages[static_cast<std::size_t>(k)].stance[kLegs[static_cast<std::size_t>(i / 3)]])
        inputs.emplace_back(k, i);
    }
  }
  const auto n = static_cast<Eigen::Index>(inputs.size());
  const auto at = [&](const Eigen::VectorXd& v) {
    std::array<Vec12, kMaxHorizon> u;
    for (Vec12& x : u) x.setZero();
    for (Eigen::Index i = 0; i < n; ++i)
      u[static_cast<std::size_t>(inputs[static_cast<std::size_t>(i)].first)]
       [inputs[static_cast<std::size_t>(i)].second] = v[i];
    return CalcObjective(qp, u);
  };
  // The objective is quadratic: finite differences with unit steps are exact up to rounding.
  Eigen::MatrixXd G(n, n);
  Eigen::VectorXd g(n);
  const double f0 = at(Eigen::VectorXd::Zero(n));
  std::vector<double> single(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i)
    single[static_cast<std::size_t>(i)] = at(Eigen::VectorXd::Unit(n, i));
  for (Eigen::Index i = 0; i < n; ++i) {
    const double fi = single[static_cast<std::size_t>(i)];
    G(i, i) = at(2.0 * Eigen::VectorXd::Unit(n, i)) - 2.0 * fi + f0;
    g[i] = fi - f0 - 0.5 * G(i, i);
    for (Eigen::Index j = 0; j < i; ++j) {
      G(i, j) = G(j, i) = at(Eigen::VectorXd::Unit(n, i) + Eigen::VectorXd::Unit(n, j)) - fi -
                          single[static_cast<std::size_t>(j)] + f0;
    }
  }
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * n);
  for (Eigen::Index foot = 0; foot < n / 3; ++foot) {
    const double signs[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (Eigen::Index r = 0; r < 4; ++r) {
      A(6 * foot + r, 3 * foot) = signs[r][0];
      A(6 * foot + r, 3 * foot + 1) = signs[r][1];
      A(6 * foot + r, 3 * foot + 2) = qp.friction;
    }
    A(6 * foot + 4, 3 * foot + 2) = 1.0;
    b[6 * foot + 4] = qp.f_min_N;
    A(6 * foot + 5, 3 * foot + 2) = -1.0;
    b[6 * foot + 5] = -qp.f_max_N;
  }
  const auto solver = std::make_unique<DualActiveSet<72, 144>>();
  DualActiveSet<72, 144>::Result result;
  solver->Solve(G, g, A, b, result);
  EXPECT_EQ(result.status, SolveStatus::kOptimal);
  return at(result.x);
}

// Two independent methods, one sparse and one dense, must find the same optimum.
TEST(RiccatiIpm, AgreesWithTheCondensedActiveSetSolution) {
  core::Rng rng(2, 0, core::Stream::kSensor);
  RiccatiIpmParams params;
  params.tolerance = 1e-10;
  params.max_iterations = 60;
  RiccatiIpm solver(params);
  for (int trial = 0; trial < 20; ++trial) {
    const OcpQp qp = test::SampleOcp(rng, trial % 2 == 0);
    const OcpSolution& solution = solver.Solve(qp);
    ASSERT_EQ(solution.status, SolveStatus::kOptimal) << trial;
    const double dense = DenseOptimum(qp), sparse = CalcObjective(qp, solution.u);
    EXPECT_NEAR(sparse, dense, 1e-6 * (1.0 + std::abs(dense))) << trial;
    for (int k = 0; k < qp.horizon; ++k) {
      const OcpStage& s = qp.stages[static_cast<std::size_t>(k)];
      const Vec12 next = s.Drift(solution.x[static_cast<std::size_t>(k)]) + s.b +
                         s.B * solution.u[static_cast<std::size_t>(k)];
      EXPECT_LT((next - solution.x[static_cast<std::size_t>(k) + 1]).norm(), 1e-12);
    }
  }
}

TEST(RiccatiIpm, FlightWithoutFeetAndBrokenDataAreHandled) {
  core::Rng rng(3, 0, core::Stream::kSensor);
  OcpQp qp = test::SampleOcp(rng, true);
  for (auto& stage : qp.stages) stage.stance = LegArray<bool>(false);
  RiccatiIpm solver{RiccatiIpmParams{}};
  const OcpSolution& solution = solver.Solve(qp);
  EXPECT_EQ(solution.status, SolveStatus::kOptimal);
  EXPECT_EQ(solution.u[0], Vec12::Zero());
  qp = test::SampleOcp(rng, true);
  qp.x0[2] = std::nan("");
  EXPECT_FALSE(IsUsable(solver.Solve(qp).status));
}

// The benchmark's warm start relies on it: what a solver does next depends on its last problem
// alone once it was reset.
TEST(RiccatiIpm, ResetForgetsEverything) {
  core::Rng rng(4, 0, core::Stream::kSensor);
  const OcpQp first = test::SampleOcp(rng, true), second = test::SampleOcp(rng, true);
  RiccatiIpm fresh{RiccatiIpmParams{}}, used{RiccatiIpmParams{}};
  const std::array<Vec12, kMaxHorizon> expected = fresh.Solve(first).u;
  const int cold = fresh.solution().iterations;
  (void)used.Solve(second);
  used.Reset();
  EXPECT_EQ(used.Solve(first).u[0], expected[0]);
  EXPECT_EQ(used.solution().iterations, cold);
  EXPECT_LT(used.Solve(first).iterations, cold) << "started from its solution";
}

}  // namespace
}  // namespace scoria::controller
