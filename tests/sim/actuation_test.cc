// SPDX-License-Identifier: BSD-3-Clause
#include "sim/actuation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

TEST(Actuation, TorqueIsLimitedByEffortAndSpeed) {
  Actuation actuation(test::Go2());
  JointCommand command;
  command.tau_Nm[Leg::kFL] = {100.0, 100.0, -100.0};
  LegArray<Vec3> qd = ZeroPerLeg();
  (void)actuation.Update(command, ZeroPerLeg(), qd, 1e-3);
  EXPECT_EQ(actuation.motor_tau_Nm()[Leg::kFL], Vec3(23.7, 23.7, -45.43));
  qd[Leg::kFL] = {30.1, -30.1, 0.0};  // no-load speed: no torque forwards, full torque for braking
  (void)actuation.Update(command, ZeroPerLeg(), qd, 1e-3);
  EXPECT_NEAR(actuation.motor_tau_Nm()[Leg::kFL].x(), 0.0, 1e-9);
  EXPECT_EQ(actuation.motor_tau_Nm()[Leg::kFL].y(), 23.7);
}

TEST(Actuation, JointControlPullsTowardsTheTarget) {
  Actuation actuation(test::Go2());
  JointCommand command;
  command.q[Leg::kHR] = {0.1, 0.0, 0.0};
  command.qd[Leg::kHR] = {0.0, 0.5, 0.0};
  command.kp_Nm_per_rad[Leg::kHR] = Vec3::Constant(50.0);
  command.kd_Nms_per_rad[Leg::kHR] = Vec3::Constant(2.0);
  const LegArray<Vec3> tau = actuation.Update(command, ZeroPerLeg(), ZeroPerLeg(), 1e-3);
  EXPECT_NEAR(tau[Leg::kHR].x(), 5.0, 1e-12);
  EXPECT_NEAR(tau[Leg::kHR].y(), 1.0, 1e-12);
}

TEST(Actuation, EnergyCountsWorkAndHeat) {
  Actuation actuation(test::Go2());
  JointCommand command;
  command.tau_Nm[Leg::kFL] = {2.0, 0.0, 0.0};
  command.tau_Nm[Leg::kFR] = {-3.0, 0.0, 0.0};
  LegArray<Vec3> qd = ZeroPerLeg();
  qd[Leg::kFL].x() = qd[Leg::kFR].x() = 4.0;
  const double dt = 1e-3;
  (void)actuation.Update(command, ZeroPerLeg(), qd, dt);
  const core::MotorParams& m = test::Go2().config.motors;
  EXPECT_NEAR(actuation.energy().mech_abs_J, (8.0 + 12.0) * dt, 1e-12);
  EXPECT_NEAR(actuation.energy().mech_pos_J, 8.0 * dt, 1e-12);
  const double k = m.copper_loss_W_per_Nm2.x();  // the braking joint gives nothing back
  EXPECT_NEAR(actuation.energy().electrical_W,
              m.idle_W + 8.0 + 4.0 * k + std::max(0.0, -12.0 + 9.0 * k), 1e-9);
}

}  // namespace
}  // namespace scoria::sim
