// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/problems/kkt.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "controller/qp/solvers/riccati_ipm.h"
#include "tests/support/qp_problems.h"

namespace scoria::controller {
namespace {

/// min ½|z|² − 2z₀ − z₁  s.t.  z₀ + z₁ = 2,  z₀ ≤ 1.25,  z₁ − z₀ ≥ −10: by hand z = (1.25, 0.75),
/// y = 0.25, bound multiplier 0.5.
struct ByHand {
  DenseQp qp;
  DensePoint point;
  ByHand() {
    qp.H = Eigen::Matrix2d::Identity();
    qp.g = Eigen::Vector2d(-2.0, -1.0);
    qp.A = Eigen::RowVector2d(1.0, 1.0);
    qp.b = Eigen::Matrix<double, 1, 1>(2.0);
    qp.C = Eigen::RowVector2d(-1.0, 1.0);
    qp.l = Eigen::Matrix<double, 1, 1>(-10.0);
    qp.u = Eigen::Matrix<double, 1, 1>(DenseQp::kUnbounded);
    qp.lb = Eigen::Vector2d::Constant(-DenseQp::kUnbounded);
    qp.ub = Eigen::Vector2d(1.25, DenseQp::kUnbounded);
    point.z = Eigen::Vector2d(1.25, 0.75);
    point.y = Eigen::Matrix<double, 1, 1>(0.25);
    point.of_rows = Eigen::Matrix<double, 1, 1>(0.0);
    point.of_bounds = Eigen::Vector2d(0.5, 0.0);
  }
  [[nodiscard]] KktResidual residual() const { return CalcKkt(qp, point); }
};

TEST(Kkt, DenseSolutionByHandHoldsExactly) {
  const KktResidual r = ByHand().residual();
  EXPECT_EQ(r.primal, 0.0);
  EXPECT_EQ(r.dual, 0.0);
  EXPECT_EQ(r.stationarity, 0.0);
  EXPECT_EQ(r.complementarity, 0.0);
  EXPECT_TRUE(kActiveSetLimits.Hold(r));
}

TEST(Kkt, EachFaultOfADenseSolutionShowsWhereItBelongs) {
  ByHand moved;
  moved.point.z[0] += 0.1;
  EXPECT_NEAR(moved.residual().primal, 0.1, 1e-12) << "equality and bound";
  ByHand unbalanced;
  unbalanced.point.y[0] += 1e-3;
  EXPECT_NEAR(unbalanced.residual().stationarity, 1e-3, 1e-12);
  ByHand slack;
  slack.point.of_rows[0] = -1e-3;  // pushes on a row that is 9.5 away
  EXPECT_NEAR(slack.residual().complementarity, 1e-3 * 9.5 / 1.25, 1e-12);
  ByHand wrong_side;
  wrong_side.point.of_bounds[0] = -0.5;  // of a lower bound that is none
  EXPECT_EQ(wrong_side.residual().dual, 0.5);
  ByHand nan;
  nan.point.z[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(kInteriorPointLimits.Hold(nan.residual()));
}

TEST(Kkt, EqualityMultipliersAreCompleted) {
  const ByHand hand;
  DenseSolution s;
  s.z = hand.point.z;
  s.of_rows = hand.point.of_rows;
  s.of_bounds = hand.point.of_bounds;
  const DensePoint p = CompletePoint(hand.qp, s);
  EXPECT_NEAR(p.y[0], 0.25, 1e-15);
}

/// A problem and its solution, closer than the control loop asks for.
struct Solved {
  OcpQp qp;
  OcpPoint point;
  explicit Solved(bool euler) {
    core::Rng rng(31, 0, core::Stream::kSensor);
    qp = test::SampleOcp(rng, euler);
    RiccatiIpmParams params;
    params.tolerance = 1e-10;
    params.max_iterations = 60;
    RiccatiIpm solver(params);
    const OcpSolution& s = solver.Solve(qp);
    EXPECT_EQ(s.status, SolveStatus::kOptimal);
    point = CompletePoint(qp, s);
  }
  [[nodiscard]] bool Holds() const { return kInteriorPointLimits.Hold(CalcKkt(qp, point)); }
};

TEST(Kkt, OcpSolutionsHoldAndPerturbedOnesDoNot) {
  for (const bool euler : {true, false}) {
    const Solved solved(euler);
    const KktResidual r = CalcKkt(solved.qp, solved.point);
    EXPECT_LT(r.primal, 1e-9);
    EXPECT_LE(r.dual, 0.0);
    EXPECT_LT(r.stationarity, 1e-3);
    EXPECT_LT(r.complementarity, 1e-9);
    Solved u = solved, x = solved, pi = solved, lambda = solved, sign = solved, nan = solved;
    u.point.u[2][2] += 1.0;
    EXPECT_FALSE(u.Holds());
    x.point.x[3][7] += 1e-3;
    EXPECT_FALSE(x.Holds());
    pi.point.pi[1][5] += 1.0;
    EXPECT_FALSE(pi.Holds());
    lambda.point.lambda[1][Leg::kFL][4] += 1.0;
    EXPECT_FALSE(lambda.Holds());
    sign.point.lambda[1][Leg::kFL][4] = -1e-6;
    EXPECT_FALSE(sign.Holds());
    nan.point.lambda[5][Leg::kHR][0] = std::nan("");
    EXPECT_FALSE(nan.Holds());
    Solved idle = solved;
    idle.point.u[0][4] = 1e-3;  // FR is in the air
    EXPECT_FALSE(idle.Holds());
  }
}

TEST(Kkt, WorseOfTwoKeepsNan) {
  KktResidual r{.primal = 1.0, .dual = std::nan("")};
  r.Worsen({.primal = 0.5, .dual = 2.0, .stationarity = 3.0});
  EXPECT_EQ(r.primal, 1.0);
  EXPECT_TRUE(std::isnan(r.dual));
  EXPECT_EQ(r.stationarity, 3.0);
}

}  // namespace
}  // namespace scoria::controller
