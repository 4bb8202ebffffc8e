// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>

#include <gtest/gtest.h>

#include "controller/controller.h"
#include "sim/actuation.h"
#include "sim/sensors/sensors.h"
#include "sim/world.h"
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
    sim::World world(robot, ground, {}, gravity_W);
    world.Reset(test::StandingState());
    sim::Actuation actuation(robot);
    sim::Sensors sensors(robot, gravity_W, 0.001);
    ControllerParams params;
    params.gait = gait;
    params.legs.late_contact = AirborneFoot::kLower;
    Controller controller(params, robot, 9.81, 0.001, Controller::Start::kStanding);
    long allocations = 0;
    for (int step = 0; step < 2500; ++step) {
      const SensorFrame z = sensors.Read(world.truth(), actuation.motor_tau_Nm(), step, true);
      Command command;
      if (step > 500) command.v_x_mps = 0.4;
      const ControlOutput* out = nullptr;
      {
        const test::AllocationGuard guard;
        out = &controller.Step(z, command);
        allocations += guard.count();
      }
      world.Step(actuation.Update(out->command, z.q, z.qd, 0.001));
    }
    EXPECT_EQ(allocations, 0);
    EXPECT_GT(world.truth().state.p_WB.x(), 0.3) << "it walked";
  }
}

// The controller runs on what sensors say: without `truth` in the frame it stays at its last
// estimate and sees nothing else.
TEST(Controller, DoesNotSeeTheSimulatorBesideTheSensorFrame) {
  Controller controller({}, test::Go2(), 9.81, 0.001, Controller::Start::kStanding);
  SensorFrame z;
  z.truth = SensorFrame::Truth{test::StandingState(), LegArray<bool>(true)};
  (void)controller.Step(z, {});
  z.truth.reset();
  z.q[Leg::kFL].x() = 1.0;
  EXPECT_EQ(controller.Step(z, {}).estimate.state, test::StandingState());
}

}  // namespace
}  // namespace scoria::controller
