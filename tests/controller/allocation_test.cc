// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include <gtest/gtest.h>

#include "controller/controller.h"
#include "sim/actuation.h"
#include "sim/plant/plant.h"
#include "sim/sensors/sensors.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

TEST(AllocationGuard, CountsWhatItShould) {
  if (!test::AllocationGuard::IsArmed()) GTEST_SKIP() << "the sanitizer owns the allocator";
  const test::AllocationGuard guard;
  void* volatile block = std::malloc(8);  // volatile: the compiler may drop an unused allocation
  std::free(block);
  EXPECT_GE(guard.count(), 1);
}

// Two seconds of walking on level ground, for every gait: no tick of the controller touches the
// heap.
TEST(Controller, StepNeverAllocates) {
  if (!test::AllocationGuard::IsArmed()) GTEST_SKIP() << "the sanitizer owns the allocator";
  for (const GaitParams& gait :
       {GaitParams(AgsParams{}), GaitParams(SgsParams{}), GaitParams(SgsMatchedParams{})}) {
    const core::RobotDescription& robot = test::Go2();
    const terrains::Heightfield ground = test::FlatGround();
    const Vec3 gravity_W(0.0, 0.0, -9.81);
    sim::Plant plant(robot, ground, {}, gravity_W);
    plant.Reset(test::StandingState());
    sim::Actuation actuation(robot);
    sim::Sensors sensors(robot, sim::RealisticSensors{}, {}, gravity_W, 0.001, 1);
    ControllerParams params;
    params.gait = gait;
    params.legs.late_contact = AirborneFoot::kLower;
    Controller controller(params, robot, 9.81, 0.001);
    long allocations = 0;
    for (int step = 0; step < 2500; ++step) {
      const double time_s = 0.001 * step;
      const SensorFrame z = sensors.Read(plant.truth(), actuation.motor_tau_Nm(), step,
                                         {time_s, 0.0, time_s}, NeedsTruth(params));
      Command command;
      if (step > 500) command.v_x_mps = 0.4;
      const ControlOutput* out = nullptr;
      {
        const test::AllocationGuard guard;
        out = &controller.Step(z, command);
        allocations += guard.count();
      }
      plant.Step(actuation.Update(out->command, {z.q, z.qd}, plant.truth().state.qd, 0.001));
    }
    EXPECT_EQ(allocations, 0);
    EXPECT_GT(plant.truth().state.p_WB.x(), 0.3) << "it walked";
  }
}

// Standing up obeys the guard, too: a robot on its side is damped, not driven.
TEST(Controller, StandUpCommandsPassTheOutputGuard) {
  ControllerParams params;
  params.estimator = TruthEstimatorParams{};
  Start start;
  start.pose = Start::Pose::kLying;
  Controller controller(params, test::Go2(), 9.81, 0.001, start);
  SensorFrame z;
  z.a_WS_S = Vec3(0.0, 9.81, 0.0);
  SensorFrame::Truth truth;
  truth.state = test::StandingState();
  truth.state.R_WB = Eigen::AngleAxisd(1.5, Vec3::UnitX()).toRotationMatrix();
  z.q = truth.state.q;
  z.truth = truth;
  EXPECT_EQ(controller.Step(z, {}).command.kp_Nm_per_rad, ZeroPerLeg());
  EXPECT_EQ(controller.counters()[Count::kTiltStop], 1u);
}

// Two worlds that differ in truth alone give the same commands, whichever estimator runs; and a
// stage that asks for the truth is the only one that is given it.
TEST(Controller, SeesTheSensorsAlone) {
  ControllerParams params;
  EXPECT_FALSE(NeedsTruth(params));
  for (const EstimatorParams& estimator :
       {EstimatorParams(InekfEstimatorParams{}), EstimatorParams(LinearKfParams{}),
        EstimatorParams(LegOdometryParams{})}) {
    params.estimator = estimator;
    EXPECT_FALSE(NeedsTruth(params));
    Controller blind(params, test::Go2(), 9.81, 0.001), tempted(params, test::Go2(), 9.81, 0.001);
    SensorFrame z;
    z.q = test::StandingState().q;
    z.a_WS_S = Vec3(0.0, 0.0, 9.81);
    for (int step = 0; step < 600; ++step) {
      z.step = step;
      z.imu_time_s = 0.001 * step;
      z.truth.reset();
      const JointCommand expected = blind.Step(z, {}).command;
      z.truth = SensorFrame::Truth{test::StandingState(), LegArray<bool>(true)};
      z.truth->state.p_WB.x() = step;
      EXPECT_EQ(tempted.Step(z, {}).command, expected);
    }
  }
  params.estimator = TruthEstimatorParams{};
  EXPECT_TRUE(NeedsTruth(params));
  params.estimator = InekfEstimatorParams{};
  params.contact.source = ContactChoice::kTruth;
  EXPECT_TRUE(NeedsTruth(params));
}

}  // namespace
}  // namespace scoria::controller
