// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "controller/controller.h"
#include "tests/support/closed_loop.h"
#include "tests/support/robots.h"

namespace scoria::controller {
namespace {

using test::ClosedLoop;
using test::LoopParams;

LoopParams WithOffset(double offset_kg) {
  LoopParams params;
  params.controller.model.mass_offset_kg = offset_kg;
  return params;
}

TEST(MassOffset, IsWhatTheControllerActsOn) {
  const terrains::Heightfield ground = test::FlatGround();
  ClosedLoop loop(WithOffset(4.0), test::Go2(), ground);
  loop.Run(10);
  EXPECT_DOUBLE_EQ(loop.control().model_mass_kg, test::Go2().total_mass_kg() + 4.0);
  const core::SpatialInertia& trunk = test::Go2().trunk;
  EXPECT_EQ(loop.controller.model().trunk.p_OC, trunk.p_OC);
  EXPECT_EQ(loop.controller.model().trunk.I_C, trunk.I_C);
}

TEST(MassOffset, OfZeroChangesNoBit) {
  const terrains::Heightfield ground = test::FlatGround();
  ClosedLoop plain({}, test::Go2(), ground), zero(WithOffset(0.0), test::Go2(), ground),
      heavy(WithOffset(4.0), test::Go2(), ground);
  plain.Run(1000);
  zero.Run(1000);
  heavy.Run(1000);
  EXPECT_EQ(zero.hash(), plain.hash());
  EXPECT_NE(heavy.hash(), plain.hash());
}

// Who knows the robot's mass from before keeps it: the offset is not added again after a fall.
TEST(MassOffset, IsAddedOnce) {
  ControllerParams params;
  params.model.mass_offset_kg = 2.0;
  const Controller first(params, test::Go2(), 9.81, 0.001);
  Start start;
  start.model = first.model();
  const Controller second(params, test::Go2(), 9.81, 0.001, start);
  EXPECT_EQ(second.model(), first.model());
}

TEST(MassOffset, ChangesWhileWalking) {
  ControllerParams params;
  Controller controller(params, test::Go2(), 9.81, 0.001);
  const double trunk_kg = controller.model().trunk.mass_kg;
  params.model.mass_offset_kg = 3.0;
  controller.Reconfigure(params);
  EXPECT_DOUBLE_EQ(controller.model().trunk.mass_kg, trunk_kg + 3.0);
  params.model.mass_offset_kg = 1.0;
  controller.Reconfigure(params);
  EXPECT_DOUBLE_EQ(controller.model().trunk.mass_kg, trunk_kg + 1.0);
}

// A wrong mass to begin with is what an adaptation is there for.
TEST(MassOffset, IsLearnedAway) {
  const terrains::Heightfield ground = test::FlatGround();
  LoopParams params = WithOffset(4.0);
  params.controller.adaptation = RlsParams{};
  ClosedLoop loop(params, test::Go2(), ground);
  loop.Run(6000);
  EXPECT_LT(loop.control().model_mass_kg, test::Go2().total_mass_kg() + 2.0);
}

}  // namespace
}  // namespace scoria::controller
