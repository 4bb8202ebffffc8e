// SPDX-License-Identifier: BSD-3-Clause
#include "sim/actuation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

const LegArray<Vec3> kRest = ZeroPerLeg();
const Actuation::Encoders kStill{kRest, kRest};

TEST(Actuation, TorqueIsLimitedByEffortAndSpeed) {
  Actuation actuation(test::Go2());
  JointCommand command;
  command.tau_Nm[Leg::kFL] = {100.0, 100.0, -100.0};
  LegArray<Vec3> qd = ZeroPerLeg();
  (void)actuation.Update(command, kStill, qd, 1e-3);
  EXPECT_EQ(actuation.motor_tau_Nm()[Leg::kFL], Vec3(23.7, 23.7, -45.43));
  qd[Leg::kFL] = {30.1, -30.1, 0.0};  // no-load speed: no torque forwards, full torque for braking
  (void)actuation.Update(command, kStill, qd, 1e-3);
  EXPECT_NEAR(actuation.motor_tau_Nm()[Leg::kFL].x(), 0.0, 1e-9);
  EXPECT_EQ(actuation.motor_tau_Nm()[Leg::kFL].y(), 23.7);
}

TEST(Actuation, TorqueLimitScalesAtEverySpeed) {
  Actuation actuation(test::Go2());
  JointCommand command;
  command.tau_Nm[Leg::kFL] = {100.0, -100.0, 1.0};
  LegArray<Vec3> qd = ZeroPerLeg();
  qd[Leg::kFL].y() = -0.85 * 30.1;  // half-way from the knee of the envelope to no load
  actuation.SetTorqueLimitScale(0.5);
  (void)actuation.Update(command, kStill, qd, 1e-3);
  EXPECT_EQ(actuation.motor_tau_Nm()[Leg::kFL].x(), 0.5 * 23.7);
  EXPECT_NEAR(actuation.motor_tau_Nm()[Leg::kFL].y(), -0.5 * 0.5 * 23.7, 1e-9);
  EXPECT_EQ(actuation.motor_tau_Nm()[Leg::kFL].z(), 1.0) << "within the limit";
  actuation.SetTorqueLimitScale(2.0);
  (void)actuation.Update(command, kStill, kRest, 1e-3);
  EXPECT_EQ(actuation.motor_tau_Nm()[Leg::kFL].x(), 2.0 * 23.7);
}

TEST(Actuation, JointControlPullsTowardsTheTarget) {
  Actuation actuation(test::Go2());
  JointCommand command;
  command.q[Leg::kHR] = {0.1, 0.0, 0.0};
  command.qd[Leg::kHR] = {0.0, 0.5, 0.0};
  command.kp_Nm_per_rad[Leg::kHR] = Vec3::Constant(50.0);
  command.kd_Nms_per_rad[Leg::kHR] = Vec3::Constant(2.0);
  const LegArray<Vec3> tau = actuation.Update(command, kStill, kRest, 1e-3);
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
  (void)actuation.Update(command, kStill, qd, dt);
  actuation.Meter(qd, qd, dt);
  const core::MotorParams& m = test::Go2().config.motors;
  EXPECT_NEAR(actuation.energy().mech_abs_J, (8.0 + 12.0) * dt, 1e-12);
  EXPECT_NEAR(actuation.energy().mech_pos_J, 8.0 * dt, 1e-12);
  const double k = m.copper_loss_W_per_Nm2.x();  // the braking joint gives nothing back
  EXPECT_NEAR(actuation.energy().electrical_W,
              m.idle_W + 8.0 + 4.0 * k + std::max(0.0, -12.0 + 9.0 * k), 1e-9);
}

// The drive damps what its encoders measure; what it can push and what that costs is the joint's.
TEST(Actuation, DriveActsOnItsEncodersAndPhysicsOnTheJoint) {
  Actuation actuation(test::Go2());
  JointCommand command;
  command.tau_Nm[Leg::kFL].x() = 20.0;
  command.kd_Nms_per_rad[Leg::kFL].x() = 1.0;
  LegArray<Vec3> measured = ZeroPerLeg(), before = ZeroPerLeg(), after = ZeroPerLeg();
  measured[Leg::kFL].x() = 2.0;
  before[Leg::kFL].x() = 3.0;
  after[Leg::kFL].x() = 5.0;
  (void)actuation.Update(command, {measured, measured}, before, 1e-3);
  EXPECT_EQ(actuation.motor_tau_Nm()[Leg::kFL].x(), 18.0);
  actuation.Meter(before, after, 1e-3);
  EXPECT_NEAR(actuation.energy().mech_pos_J, 18.0 * 4.0 * 1e-3, 1e-12);
  before[Leg::kFL].x() = 30.1;  // the no-load speed, whatever the encoder says
  (void)actuation.Update(command, {measured, measured}, before, 1e-3);
  EXPECT_NEAR(actuation.motor_tau_Nm()[Leg::kFL].x(), 0.0, 1e-9);
}

TEST(Actuation, CommandsArriveAfterTheirDelay) {
  core::RobotDescription robot = test::Go2();
  robot.config.motors.delay_s = 0.003;
  Actuation actuation(robot);
  const auto torque_of = [&](double tau_Nm) {
    JointCommand command;
    command.tau_Nm[Leg::kFL].x() = tau_Nm;
    return actuation.Update(command, kStill, kRest, 1e-3)[Leg::kFL].x();
  };
  std::vector<double> got;
  for (const double tau : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}) got.push_back(torque_of(tau));
  EXPECT_EQ(got, (std::vector<double>{1.0, 1.0, 1.0, 1.0, 2.0, 3.0}));
  actuation.Reset();
  EXPECT_EQ(torque_of(9.0), 9.0);  // what was on its way is forgotten
}

// P = (V_open − I R) I; a full discharge delivers the mean open-circuit voltage times the charge.
TEST(Battery, CurrentVoltageAndChargeFollowTheCircuit) {
  const core::BatteryParams params{33.6, 24.0, 8.0, 0.1, 1.0};
  Battery battery(params);
  battery.Draw(200.0, 1e-3);
  const BatteryState first = battery.state();
  EXPECT_NEAR(first.voltage_V * first.current_A, 200.0, 1e-9);
  EXPECT_NEAR(first.voltage_V, 33.6 - 0.1 * first.current_A, 1e-9);
  double hours = 0.0;
  for (; battery.state().charge > 1e-3 && hours < 3.0; hours += 1.0 / 3600.0)
    battery.Draw(200.0, 1.0);
  EXPECT_NEAR(battery.state().delivered_J, 0.5 * (33.6 + 24.0) * 8.0 * 3600.0, 2e3);
  EXPECT_NEAR(hours, 28.8 * 8.0 / 200.0, 0.05);  // less the loss in the cells
  EXPECT_LT(battery.state().voltage_V, 24.0);
}

TEST(Battery, OverloadDrawsTheCurrentOfGreatestPower) {
  Battery battery({33.6, 24.0, 8.0, 0.1, 1.0});
  battery.Draw(1e5, 1e-3);
  EXPECT_NEAR(battery.state().current_A, 33.6 / 0.2, 1e-9);
  EXPECT_NEAR(battery.state().voltage_V, 16.8, 1e-9);
}

}  // namespace
}  // namespace scoria::sim
