// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include <gtest/gtest.h>

#include "controller/safety/output_guard.h"
#include "core/config/archive.h"
#include "core/robot_files/load.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

JointCommand Torques(double tau_Nm) {
  JointCommand command;
  command.tau_Nm = LegArray<Vec3>(Vec3::Constant(tau_Nm));
  return command;
}

TEST(OutputGuard, LeavesAnOrdinaryCommandAloneAndClampsTorques) {
  OutputGuard guard({}, test::Go2(), test::StandingState().q);
  Counters counters;
  const RobotState state = test::StandingState();
  EXPECT_EQ(guard.Check(Torques(5.0), state, GuardMode::kWalk, counters), Torques(5.0));
  EXPECT_EQ(counters, Counters{});
  const JointCommand clamped = guard.Check(Torques(1e3), state, GuardMode::kWalk, counters);
  for (const Leg leg : kLegs) EXPECT_EQ(clamped.tau_Nm[leg], test::Go2().EffortLimits()[leg]);
}

TEST(OutputGuard, NothingThatIsNotFiniteReachesAMotor) {
  OutputGuard guard({}, test::Go2(), test::StandingState().q);
  Counters counters;
  for (int field = 0; field < 5; ++field) {
    JointCommand command = Torques(1.0);
    LegArray<Vec3>* const fields[] = {&command.q, &command.qd, &command.tau_Nm,
                                      &command.kp_Nm_per_rad, &command.kd_Nms_per_rad};
    (*fields[field])[Leg::kHR].y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(guard.Check(command, test::StandingState(), GuardMode::kWalk, counters),
              guard.Damping());
  }
  EXPECT_EQ(counters[Count::kDamping], 5u);
}

TEST(OutputGuard, StopsForGoodWhenTheTrunkTips) {
  OutputGuard guard({}, test::Go2(), test::StandingState().q);
  Counters counters;
  RobotState state = test::StandingState();
  state.R_WB = Eigen::AngleAxisd(1.19, Vec3::UnitX()).toRotationMatrix();
  EXPECT_EQ(guard.Check(Torques(1.0), state, GuardMode::kWalk, counters), Torques(1.0));
  state.R_WB = Eigen::AngleAxisd(1.21, Vec3::UnitX()).toRotationMatrix();
  EXPECT_EQ(guard.Check(Torques(1.0), state, GuardMode::kWalk, counters), guard.Damping());
  state.R_WB.setIdentity();
  EXPECT_EQ(guard.Check(Torques(1.0), state, GuardMode::kWalk, counters), guard.Damping());
  EXPECT_EQ(counters[Count::kTiltStop], 1u);
}

TEST(OutputGuard, TurnsAJointBackAtItsLimitButLetsItComeIn) {
  OutputGuard guard({}, test::Go2(), test::StandingState().q);
  Counters counters;
  RobotState state = test::StandingState();
  const double upper = test::Go2().legs[Leg::kFL].joints[1].upper_rad;
  state.q[Leg::kFL].y() = upper + 0.01;
  EXPECT_EQ(guard.Check(Torques(-5.0), state, GuardMode::kWalk, counters).tau_Nm[Leg::kFL].y(),
            -5.0);
  const JointCommand safe = guard.Check(Torques(5.0), state, GuardMode::kWalk, counters);
  EXPECT_LT(safe.kp_Nm_per_rad[Leg::kFL].y() * (safe.q[Leg::kFL].y() - state.q[Leg::kFL].y()), 0.0);
  EXPECT_EQ(safe.tau_Nm[Leg::kFL].y(), 0.0);
  EXPECT_EQ(safe.tau_Nm[Leg::kFL].x(), 5.0) << "other joints keep their command";
  EXPECT_EQ(counters[Count::kJointLimit], 1u);
}

TEST(OutputGuard, KeepsAKneeFromFoldingThroughStraight) {
  const core::RobotDescription robot = core::LoadRobot(core::ReadConfig<core::RobotConfig>(
      core::LoadConfig(test::SourcePath("robots/b12/b12.yaml"))));
  const LegArray<Vec3> standing(Vec3(0.0, 0.75, -1.5));
  OutputGuard guard({}, robot, standing);
  Counters counters;
  RobotState state = test::StandingState();
  state.q = standing;
  state.q[Leg::kFL].z() = -0.2;  // far within the URDF's limits
  const JointCommand safe = guard.Check(Torques(5.0), state, GuardMode::kWalk, counters);
  EXPECT_LT(safe.kp_Nm_per_rad[Leg::kFL].z() * (safe.q[Leg::kFL].z() - state.q[Leg::kFL].z()), 0.0);
  EXPECT_EQ(counters[Count::kJointLimit], 1u);
  EXPECT_EQ(guard.Check(Torques(-5.0), state, GuardMode::kWalk, counters).tau_Nm[Leg::kFL].z(),
            -5.0);
}

TEST(StandInPlan, SharesTheWeightAmongTheFeetThatStand) {
  const LegArray<bool> contact(true, false, true, true);
  const ForcePlan plan = StandInPlan(150.0, contact, BodyReference{}, 0.05);
  const LegArray<Vec3> f = plan.ForcesFor(contact, Vec3::UnitZ());
  EXPECT_EQ(f[Leg::kFL], Vec3(0.0, 0.0, 50.0));
  EXPECT_EQ(f[Leg::kFR], Vec3::Zero().eval());
  EXPECT_TRUE(IsFinite(plan));
  EXPECT_TRUE(IsFinite(StandInPlan(150.0, LegArray<bool>(false), BodyReference{}, 0.05)));
}

}  // namespace
}  // namespace scoria::controller
