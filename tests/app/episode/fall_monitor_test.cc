// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/fall_monitor.h"

#include <gtest/gtest.h>

#include "core/math/so3.h"

namespace scoria::app {
namespace {

sim::Truth Upright() {
  sim::Truth truth;
  truth.state.p_WB.z() = 0.3;
  return truth;
}

FallCause RunFor(FallMonitor& monitor, const sim::Truth& truth, double seconds) {
  for (int i = 0; i < static_cast<int>(seconds * 1000); ++i) {
    const FallCause cause = monitor.Update(truth, 0.0);
    if (cause != FallCause::kNone) return cause;
  }
  return FallCause::kNone;
}

TEST(FallMonitor, TrunkMustBearForceForATenthOfASecond) {
  FallMonitor monitor({}, 0.3, 0.001);
  sim::Truth pressed = Upright();
  pressed.trunk_force_N = 50.0;
  EXPECT_EQ(RunFor(monitor, pressed, 0.09), FallCause::kNone);
  EXPECT_EQ(RunFor(monitor, Upright(), 0.01), FallCause::kNone);  // relief starts the clock again
  EXPECT_EQ(RunFor(monitor, pressed, 0.09), FallCause::kNone);
  EXPECT_EQ(RunFor(monitor, pressed, 0.05), FallCause::kTrunkContact);
}

TEST(FallMonitor, TiltCountsAtOnceAndLowAfterAWhile) {
  FallMonitor monitor({}, 0.3, 0.001);
  sim::Truth tilted = Upright();
  tilted.state.R_WB = core::RotationFromRpy({1.1, 0.0, 0.0});
  EXPECT_EQ(RunFor(monitor, tilted, 0.001), FallCause::kTilt);
  sim::Truth low = Upright();
  low.state.p_WB.z() = 0.1;
  EXPECT_EQ(RunFor(monitor, low, 0.19), FallCause::kNone);
  EXPECT_EQ(RunFor(monitor, low, 0.05), FallCause::kLow);
}

TEST(FallMonitor, BeforeTheControllerIsInChargeTiltAndNotStandingCount) {
  FallMonitor monitor({}, 0.3, 0.001);
  sim::Truth folded = Upright();
  folded.state.p_WB.z() = 0.07;
  folded.trunk_force_N = 100.0;
  EXPECT_EQ(monitor.UpdateStandUp(folded, -1.0), FallCause::kNone);
  EXPECT_EQ(monitor.UpdateStandUp(folded, 2.9), FallCause::kNone);
  EXPECT_EQ(monitor.UpdateStandUp(folded, 3.1), FallCause::kNotStanding);
  folded.state.R_WB = core::RotationFromRpy({1.1, 0.0, 0.0});
  EXPECT_EQ(monitor.UpdateStandUp(folded, -1.0), FallCause::kTilt);
}

TEST(FallMonitor, StuckNeedsACommandAndTenSeconds) {
  FallMonitor monitor({}, 0.3, 0.001);
  const Vec3 here = Vec3::Zero();
  int stuck = 0;
  for (int i = 0; i < 9900; ++i) stuck += monitor.UpdateStuck(here, 0.3);
  EXPECT_EQ(stuck, 0);
  for (int i = 0; i < 200; ++i) stuck += monitor.UpdateStuck(here, 0.3);
  EXPECT_EQ(stuck, 1);
  for (int i = 0; i < 30000; ++i) stuck += monitor.UpdateStuck(here, 0.0);
  EXPECT_EQ(stuck, 1);
}

TEST(FallMonitor, SlowWalkThatKeepsItsPaceIsNotStuck) {
  FallMonitor monitor({}, 0.3, 0.001);
  int stuck = 0;
  for (int i = 0; i < 40000; ++i) stuck += monitor.UpdateStuck({1e-5 * i, 0.0, 0.0}, 0.01);
  EXPECT_EQ(stuck, 0);
}

}  // namespace
}  // namespace scoria::app
