// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world.h"

#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "controller/model/whole_body.h"
#include "core/math/so3.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

const Vec3 kGravity(0.0, 0.0, -9.81);

/// Joint PD that holds a pose.
LegArray<Vec3> Hold(const RobotState& s, const LegArray<Vec3>& q, double kp = 100.0,
                    double kd = 3.0) {
  LegArray<Vec3> tau = ZeroPerLeg();
  for (const Leg leg : kLegs) tau[leg] = kp * (q[leg] - s.q[leg]) - kd * s.qd[leg];
  return tau;
}

TEST(World, FootForcesSumToTheWeightAtRest) {
  const terrains::Heightfield ground = test::FlatGround();
  World world(test::Go2(), ground, {}, kGravity);
  const RobotState start = test::StandingState();
  world.Reset(start);
  for (int i = 0; i < 3000; ++i) world.Step(Hold(world.truth().state, start.q));
  Vec3 sum = Vec3::Zero();
  for (const Leg leg : kLegs) sum += world.truth().f_F_W[leg];
  EXPECT_NEAR(sum.z(), test::Go2().total_mass_kg() * 9.81, 0.05);
  EXPECT_NEAR(sum.head<2>().norm(), 0.0, 0.05);
  EXPECT_EQ(world.truth().trunk_force_N, 0.0);
}

// A robot that slides down a flat tilted heightfield with locked legs: the stock heightfield shape
// kicks each foot by 40 N here, at every edge between triangles.
TEST(World, SlidingFootFeelsNoKicks) {
  const terrains::Heightfield ground = test::FlatGround(0.25, 60.0);
  const double slope = 0.35;
  World world(test::Go2(), ground, {}, 9.81 * Vec3(-std::sin(slope), 0.0, -std::cos(slope)));
  const RobotState start = test::StandingState();
  world.Reset(start);
  double sum = 0.0, squares = 0.0;
  const int kSettle = 500, kSteps = 1500;
  for (int i = 0; i < kSteps; ++i) {
    world.Step(Hold(world.truth().state, start.q, 400.0, 6.0));
    if (i < kSettle) continue;
    const double f = world.truth().f_F_W[Leg::kFL].z();
    sum += f;
    squares += f * f;
  }
  const double n = kSteps - kSettle, mean = sum / n;
  EXPECT_LT(world.truth().state.p_WB.x(), -0.5) << "it does slide";
  EXPECT_GT(mean, 5.0);
  EXPECT_LT(std::sqrt(std::max(0.0, squares / n - mean * mean)), 0.5);
}

TEST(World, FrictionHoldsAndSlipsWhereCoulombSays) {
  const double slope = 0.26;
  for (const double share : {0.97, 1.03}) {
    const terrains::Heightfield ground = test::FlatGround(share * std::tan(slope), 40.0);
    World world(test::Go2(), ground, {}, 9.81 * Vec3(-std::sin(slope), 0.0, -std::cos(slope)));
    const RobotState start = test::StandingState();
    world.Reset(start);
    for (int i = 0; i < 3000; ++i) world.Step(Hold(world.truth().state, start.q, 400.0, 6.0));
    const double speed = world.truth().state.v_WB.norm();
    if (share > 1.0) {
      EXPECT_LT(speed, 1e-3);
    } else {
      EXPECT_GT(speed, 0.1);
    }
  }
}

// Rotor inertia and damping act inside the step: without contact one step must give
// (H + A + D dt)⁻¹(tau − h − D qd) of the independent rigid-body model, whose H already includes A.
TEST(World, JointAccelerationIncludesRotorInertiaExactly) {
  const core::RobotDescription& robot = test::Go2();
  const terrains::Heightfield ground = test::FlatGround();
  PhysicsParams params;
  params.step_s = 1e-4;
  World world(robot, ground, params, kGravity);
  const controller::WholeBodyModel model(robot, 9.81);
  core::Rng rng(7, 0, core::Stream::kSensor);
  for (int trial = 0; trial < 10; ++trial) {
    RobotState s = test::RandomState(rng);
    s.p_WB.z() = 5.0;
    LegArray<Vec3> tau = ZeroPerLeg();
    Vec18 generalised = Vec18::Zero();
    for (const Leg leg : kLegs) {
      for (int j = 0; j < 3; ++j) tau[leg][j] = rng.NextUniform(-10.0, 10.0);
      const Vec3 damping = robot.config.motors.damping_Nms_per_rad.cwiseProduct(s.qd[leg]);
      generalised.segment<3>(6 + 3 * static_cast<int>(leg)) = tau[leg] - damping;
    }
    controller::WholeBody wb;
    model.Calc(s, wb);
    Mat18 H = AssembleMassMatrix(wb);
    for (int j = 6; j < 18; ++j)
      H(j, j) += params.step_s * robot.config.motors.damping_Nms_per_rad[(j - 6) % 3];
    const Vec18 expected = H.ldlt().solve(generalised - AssembleBias(wb));
    world.Reset(s);
    world.Step(tau);
    const RobotState& after = world.truth().state;
    for (const Leg leg : kLegs) {
      const Vec3 qdd = (after.qd[leg] - s.qd[leg]) / params.step_s;
      const Vec3 want = expected.segment<3>(6 + 3 * static_cast<int>(leg));
      EXPECT_LT((qdd - want).norm(), 1e-6 * (1.0 + expected.norm())) << "trial " << trial;
    }
    EXPECT_LT(((after.w_WB - s.w_WB) / params.step_s - expected.segment<3>(3)).norm(),
              1e-6 * (1.0 + expected.norm()));
  }
}

// Bullet's integrator is of first order: over half a second of tumbling the momentum stays within
// the bound that the reference measured for it (0.1 % per second), and the energy within 1 %.
TEST(World, TumblingRobotKeepsItsMomentum) {
  const core::RobotDescription& robot = test::Go2();
  const terrains::Heightfield ground = test::FlatGround();
  World world(robot, ground, {}, Vec3::Zero());
  RobotState s = test::StandingState();
  s.p_WB.z() = 10.0;
  s.w_WB = {1.0, 2.0, 3.0};
  s.v_WB = {0.5, 0.0, 0.0};
  world.Reset(s);
  const controller::WholeBodyModel model(robot, 0.0);
  controller::WholeBody before, after;
  model.Calc(world.truth().state, before);
  for (int i = 0; i < 500; ++i) world.Step(Hold(world.truth().state, s.q));
  model.Calc(world.truth().state, after);
  EXPECT_LT((after.v_WC - before.v_WC).norm(), 2e-3 * before.v_WC.norm() + 1e-3);
  EXPECT_LT(
      (after.I_C_W * after.state.w_WB).norm() / (before.I_C_W * before.state.w_WB).norm() - 1.0,
      0.02);
}

TEST(World, TwoWorldsGiveTheSameBits) {
  const terrains::Heightfield ground = test::FlatGround();
  const auto run = [&] {
    World world(test::Go2(), ground, {}, kGravity);
    RobotState start = test::StandingState();
    start.p_WB.z() += 0.05;
    start.v_WB = {0.3, 0.1, 0.0};
    world.Reset(start);
    for (int i = 0; i < 400; ++i) world.Step(Hold(world.truth().state, start.q));
    return world.truth();
  };
  EXPECT_EQ(run(), run());
}

TEST(World, ResetForgetsTheOldContacts) {
  const terrains::Heightfield ground = test::FlatGround();
  World world(test::Go2(), ground, {}, kGravity);
  const RobotState start = test::StandingState();
  const auto settle = [&] {
    world.Reset(start);
    for (int i = 0; i < 200; ++i) world.Step(Hold(world.truth().state, start.q));
    return world.truth();
  };
  EXPECT_EQ(settle(), settle());
}

TEST(World, FallenRobotReportsTheTrunksForce) {
  const terrains::Heightfield ground = test::FlatGround();
  World world(test::Go2(), ground, {}, kGravity);
  RobotState s = test::StandingState();
  s.p_WB.z() = 0.2;
  s.R_WB = core::RotationFromRpy({3.1, 0.0, 0.0});  // on its back
  world.Reset(s);
  for (int i = 0; i < 1500; ++i) world.Step(Hold(world.truth().state, s.q));
  EXPECT_GT(world.truth().trunk_force_N, 20.0);
}

}  // namespace
}  // namespace scoria::sim
