// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "app/inspect/qp_sets.h"
#include "controller/qp/dual_active_set.h"
#include "controller/qp/riccati_ipm.h"
#include "core/rng.h"

namespace scoria::controller {
namespace {

/// KKT residual of min ½ xᵀGx + gᵀx s.t. Ax ≥ b, with the best multipliers for the active rows
/// (least squares, then sign).
double KktResidual(const Eigen::MatrixXd& G, const Eigen::VectorXd& g, const Eigen::MatrixXd& A,
                   const Eigen::VectorXd& b, const Eigen::VectorXd& x) {
  const Eigen::VectorXd slack = A * x - b;
  double residual = std::max(0.0, -slack.minCoeff());
  std::vector<Eigen::Index> active;
  for (Eigen::Index i = 0; i < slack.size(); ++i) {
    if (slack[i] < 1e-8) active.push_back(i);
  }
  const Eigen::VectorXd gradient = G * x + g;
  if (active.empty()) return std::max(residual, gradient.lpNorm<Eigen::Infinity>());
  Eigen::MatrixXd N(x.size(), static_cast<Eigen::Index>(active.size()));
  for (std::size_t k = 0; k < active.size(); ++k)
    N.col(static_cast<Eigen::Index>(k)) = A.row(active[k]).transpose();
  const Eigen::VectorXd lambda = N.colPivHouseholderQr().solve(gradient);
  residual = std::max(residual, (gradient - N * lambda).lpNorm<Eigen::Infinity>());
  return std::max(residual, -lambda.minCoeff());
}

TEST(DualActiveSet, RandomProblemsSatisfyTheOptimalityConditions) {
  core::Rng rng(1, 0, core::Stream::kSensor);
  DualActiveSet<12, 44> solver;
  DualActiveSet<12, 44>::Result result;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 2 + trial % 11, m = 3 + trial % 40;
    Eigen::MatrixXd M(n, n), A(m, n);
    for (double& v : M.reshaped()) v = rng.NextNormal();
    for (double& v : A.reshaped()) v = rng.NextNormal();
    Eigen::VectorXd g(n), inside(n), b(m);
    for (double& v : g) v = 3.0 * rng.NextNormal();
    for (double& v : inside) v = rng.NextNormal();
    for (Eigen::Index i = 0; i < m; ++i)
      b[i] = A.row(i).dot(inside) - rng.NextUniform();  // feasible by construction
    const Eigen::MatrixXd G = M * M.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    solver.Solve(G, g, A, b, result);
    ASSERT_EQ(result.status, SolveStatus::kOptimal) << trial;
    EXPECT_LT(KktResidual(G, g, A, b, result.x), 1e-6) << trial;
  }
}

TEST(DualActiveSet, TellsInfeasibleAndIndefiniteProblems) {
  DualActiveSet<12, 44> solver;
  DualActiveSet<12, 44>::Result result;
  Eigen::MatrixXd A(2, 1);
  A << 1.0, -1.0;
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(1, 1);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(1);
  solver.Solve(one, zero, A, Eigen::Vector2d(1.0, 0.0), result);  // x >= 1 and x <= 0
  EXPECT_EQ(result.status, SolveStatus::kInfeasible);
  solver.Solve(-one, zero, A, Eigen::Vector2d(0.0, 0.0), result);
  EXPECT_EQ(result.status, SolveStatus::kNumerical);
  EXPECT_TRUE(std::isnan(result.x[0]));
}

/// A small trot-like problem.
OcpQp SampleProblem(core::Rng& rng, bool euler) {
  OcpQp qp;
  qp.horizon = 6;
  qp.friction = 0.5;
  qp.f_min_N = 2.0;
  qp.f_max_N = 120.0;
  qp.start_force_N = 150.0;
  qp.forward_euler = euler;
  const double dt = 0.04;
  for (double& v : qp.x0) v = 0.1 * rng.NextNormal();
  for (int k = 0; k <= qp.horizon; ++k) {
    OcpStage& s = qp.stages[static_cast<std::size_t>(k)];
    s.Q << Vec3::Constant(50.0), Vec3::Constant(80.0), Vec3::Constant(0.5), Vec3::Constant(10.0);
    s.q = -s.Q.cwiseProduct(0.1 * Vec12::Ones());
    s.E = dt * Mat3::Identity();
    s.dt_s = dt;
    s.b[11] = -dt * 9.81;
    s.R.setConstant(2e-4);
    s.stance = k % 2 == 0 ? LegArray<bool>(true, false, false, true)
                          : LegArray<bool>(true, true, true, true);
    for (const Leg leg : kLegs) {
      if (!s.stance[leg]) continue;
      for (int i = 0; i < 3; ++i) {
        s.B(9 + i, 3 * static_cast<int>(leg) + i) = dt / 15.0;
        for (int j = 0; j < 3; ++j)
          s.B(6 + i, 3 * static_cast<int>(leg) + j) = dt * rng.NextNormal();
        if (!euler) s.B(3 + i, 3 * static_cast<int>(leg) + i) = 0.5 * dt * dt / 15.0;
      }
    }
  }
  return qp;
}

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
  OcpSolution solution;
  for (int trial = 0; trial < 20; ++trial) {
    const OcpQp qp = SampleProblem(rng, trial % 2 == 0);
    solver.Solve(qp, solution);
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
  OcpQp qp = SampleProblem(rng, true);
  for (auto& stage : qp.stages) stage.stance = LegArray<bool>(false);
  RiccatiIpm solver{RiccatiIpmParams{}};
  OcpSolution solution;
  solver.Solve(qp, solution);
  EXPECT_EQ(solution.status, SolveStatus::kOptimal);
  EXPECT_EQ(solution.u[0], Vec12::Zero());
  qp = SampleProblem(rng, true);
  qp.x0[2] = std::nan("");
  solver.Solve(qp, solution);
  EXPECT_FALSE(IsUsable(solution.status));
}

// Every set of the reference data: objective gap of the MPC and distance of the WBC's solution at
// most 1e-6.
TEST(ReferenceData, AllProblemsAreSolvedToTheirKnownAnswers) {
  const char* data = std::getenv("SCORIA_REFERENCE_DATA");
  if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  for (const app::QpBenchmark& b : app::BenchmarkQpSets(std::filesystem::path(data) / "qp", 1)) {
    EXPECT_EQ(b.solved, b.problems) << b.file;
    EXPECT_EQ(b.warm_solved, b.warm_problems) << b.file;
    EXPECT_GT(b.problems, 0) << b.file;
    EXPECT_LE(b.worst_error, 1e-6) << b.file;
    EXPECT_LE(b.worst_violation, 1e-9) << b.file;
  }
}

}  // namespace
}  // namespace scoria::controller
