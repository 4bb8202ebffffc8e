// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/dual_active_set.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace scoria::controller
