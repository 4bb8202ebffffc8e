// SPDX-License-Identifier: BSD-3-Clause
// The simulator's dynamics against MuJoCo, an independent implementation.
#include <gtest/gtest.h>

#include "sim/plant/plant.h"
#include "tests/support/engines.h"
#include "tests/support/mujoco.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

using EngineAgainstMujoco = test::EngineTest;
INSTANTIATE_TEST_SUITE_P(Engines, EngineAgainstMujoco, test::AllEngines(), test::EngineOf);

LegArray<Vec3> RandomTorques(core::Rng& rng) {
  LegArray<Vec3> tau = ZeroPerLeg();
  for (Vec3& leg : tau) {
    for (double& t : leg) t = rng.NextUniform(-10.0, 10.0);
  }
  return tau;
}

Vec3 VelocityOf(const RobotState& s, const Vec3& p_BP) {
  return s.v_WB + s.w_WB.cross(s.R_WB * p_BP);
}

core::RobotDescription WithoutLosses() {
  core::RobotDescription robot = test::Go2();
  robot.config.motors.damping_Nms_per_rad.setZero();
  robot.config.motors.friction_Nm.setZero();
  return robot;
}

/// Without joint losses one step gives (H + A)⁻¹(τ − h) whatever its length.
/// @param p_BP  the point of the trunk whose velocity the engine integrates.
void ExpectMujocosAccelerations(Plant& plant, test::MujocoModel& mujoco, const Vec3& p_BP) {
  constexpr double kStep_s = 0.001;
  core::Rng rng(7, 0, core::Stream::kSensor);
  for (int trial = 0; trial < 50; ++trial) {
    RobotState s = test::RandomState(rng);
    s.p_WB.z() = 5.0;
    const LegArray<Vec3> tau = RandomTorques(rng);
    mujoco.SetTorques(tau);
    mujoco.Set(s);
    plant.Reset(s);
    plant.Step(tau);
    const RobotState& after = plant.truth().state;
    const Eigen::Map<const Vec18> qacc(mujoco.data->qacc);
    const double scale = 1e-6 * (1.0 + qacc.norm());
    const Vec3 alpha_W = s.R_WB * qacc.segment<3>(3), p_BP_W = s.R_WB * p_BP;
    const Vec3 a_WP = qacc.head<3>() + alpha_W.cross(p_BP_W) + s.w_WB.cross(s.w_WB.cross(p_BP_W));
    const Vec3 change_mps = VelocityOf(after, p_BP) - VelocityOf(s, p_BP);
    EXPECT_LT((change_mps / kStep_s - a_WP).norm(), scale);
    EXPECT_LT(((after.w_WB - s.w_WB) / kStep_s - alpha_W).norm(), scale);
    for (const Leg leg : kLegs) {
      const Vec3 qdd = (after.qd[leg] - s.qd[leg]) / kStep_s;
      EXPECT_LT((qdd - qacc.segment<3>(6 + 3 * static_cast<int>(leg))).norm(), scale) << trial;
    }
  }
}

TEST_P(EngineAgainstMujoco, FreeAccelerationWithRotorsIsMujocos) {
  const core::RobotDescription robot = WithoutLosses();
  test::MujocoModel mujoco(robot, {});
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(robot, ground, Physics(), {0.0, 0.0, -9.81});
  ExpectMujocosAccelerations(plant, mujoco, IsBullet() ? robot.trunk.p_OC : Vec3::Zero());
}

TEST_P(EngineAgainstMujoco, FreeAccelerationUnderPayloadsIsMujocos) {
  const core::RobotDescription robot = WithoutLosses();
  const PayloadParams box{"box", 3.0, {0.05, 0.1, 0.12}, {0.3, -0.5, 1.1}, {0.2, 0.1, 0.3}};
  const PayloadParams point{"point", 0.5, {0.2, 0.0, 0.1}};
  test::MujocoModel mujoco(robot, {.payloads = {box, point}});
  const terrains::Heightfield ground = test::FlatGround();
  Plant plant(robot, ground, Physics(), {0.0, 0.0, -9.81});
  const std::vector<SpatialInertia> bodies = {ToInertia(box), ToInertia(point)};
  plant.SetTrunkParameters(AddBodies(robot.trunk, bodies), AttachVelocity::kMatched);
  ExpectMujocosAccelerations(plant, mujoco, IsBullet() ? plant.truth().trunk.p_OC : Vec3::Zero());
}

/// Feet of a robot that holds its pose on flat ground carry what they carry in MuJoCo.
TEST_P(EngineAgainstMujoco, StandingForcesAreMujocos) {
  const core::RobotDescription& robot = test::Go2();
  const terrains::Heightfield ground = test::FlatGround(0.8, 10.0);
  test::MujocoModel mujoco(robot, {.joint_losses = false, .ground = &ground});
  Plant plant(robot, ground, Physics(), {0.0, 0.0, -9.81});
  const RobotState start = test::StandingState();
  plant.Reset(start);
  mujoco.Set(start);
  const auto hold = [&](const RobotState& s) {
    LegArray<Vec3> tau = ZeroPerLeg();
    for (const Leg leg : kLegs) tau[leg] = 200.0 * (start.q[leg] - s.q[leg]) - 4.0 * s.qd[leg];
    return tau;
  };
  for (int i = 0; i < 3000; ++i) {
    plant.Step(hold(plant.truth().state));
    mujoco.SetTorques(hold(mujoco.state()));
    mj_step(mujoco.model.get(), mujoco.data.get());
  }
  EXPECT_LT((plant.truth().state.p_WB - mujoco.state().p_WB).norm(), 4e-3)
      << "MuJoCo's default contact yields by millimetres";
  Vec3 sum = Vec3::Zero();
  for (const Leg leg : kLegs) sum += plant.truth().f_F_W[leg];
  EXPECT_NEAR(sum.z(), mujoco.model->body_subtreemass[1] * 9.81, IsBullet() ? 0.1 : 0.05);
}

}  // namespace
}  // namespace scoria::sim
