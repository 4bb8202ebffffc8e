// SPDX-License-Identifier: BSD-3-Clause
// The simulator's dynamics against MuJoCo, an independent implementation.
#include "sim/step_solver.h"

#include <gtest/gtest.h>

#include "sim/world.h"
#include "tests/support/mujoco.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

LegArray<Vec3> RandomTorques(core::Rng& rng) {
  LegArray<Vec3> tau = ZeroPerLeg();
  for (Vec3& leg : tau) {
    for (double& t : leg) t = rng.NextUniform(-10.0, 10.0);
  }
  return tau;
}

/// Without joint losses one step gives (H + A)⁻¹(τ − h) whatever its length.
TEST(StepSolver, FreeAccelerationWithRotorsIsMujocos) {
  core::RobotDescription robot = test::Go2();
  robot.config.motors.damping_Nms_per_rad.setZero();
  robot.config.motors.friction_Nm.setZero();
  test::MujocoModel mujoco(robot, {});
  const terrains::Heightfield ground = test::FlatGround();
  const PhysicsParams params;
  World world(robot, ground, params, {0.0, 0.0, -9.81});
  core::Rng rng(7, 0, core::Stream::kSensor);
  for (int trial = 0; trial < 50; ++trial) {
    RobotState s = test::RandomState(rng);
    s.p_WB.z() = 5.0;
    const LegArray<Vec3> tau = RandomTorques(rng);
    mujoco.SetTorques(tau);
    mujoco.Set(s);
    world.Reset(s);
    world.Step(tau);
    const RobotState& after = world.truth().state;
    const Eigen::Map<const Vec18> qacc(mujoco.data->qacc);
    const double scale = 1e-6 * (1.0 + qacc.norm());
    EXPECT_LT(((after.v_WB - s.v_WB) / params.step_s - qacc.head<3>()).norm(), scale);
    EXPECT_LT(((after.w_WB - s.w_WB) / params.step_s - s.R_WB * qacc.segment<3>(3)).norm(), scale);
    for (const Leg leg : kLegs) {
      const Vec3 qdd = (after.qd[leg] - s.qd[leg]) / params.step_s;
      EXPECT_LT((qdd - qacc.segment<3>(6 + 3 * static_cast<int>(leg))).norm(), scale) << trial;
    }
  }
}

/// Feet of a robot that holds its pose on flat ground carry what they carry in MuJoCo.
TEST(StepSolver, StandingForcesAreMujocos) {
  const core::RobotDescription& robot = test::Go2();
  const terrains::Heightfield ground = test::FlatGround(0.8, 10.0);
  test::MujocoModel mujoco(robot, {.joint_losses = false, .ground = &ground});
  World world(robot, ground, {}, {0.0, 0.0, -9.81});
  const RobotState start = test::StandingState();
  world.Reset(start);
  mujoco.Set(start);
  const auto hold = [&](const RobotState& s) {
    LegArray<Vec3> tau = ZeroPerLeg();
    for (const Leg leg : kLegs) tau[leg] = 200.0 * (start.q[leg] - s.q[leg]) - 4.0 * s.qd[leg];
    return tau;
  };
  for (int i = 0; i < 3000; ++i) {
    world.Step(hold(world.truth().state));
    mujoco.SetTorques(hold(mujoco.state()));
    mj_step(mujoco.model.get(), mujoco.data.get());
  }
  EXPECT_LT((world.truth().state.p_WB - mujoco.state().p_WB).norm(), 4e-3)
      << "MuJoCo's default contact yields by millimetres";
  Vec3 sum = Vec3::Zero();
  for (const Leg leg : kLegs) sum += world.truth().f_F_W[leg];
  EXPECT_NEAR(sum.z(), mujoco.model->body_subtreemass[1] * 9.81, 0.05);
}

}  // namespace
}  // namespace scoria::sim
