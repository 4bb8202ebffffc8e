// SPDX-License-Identifier: BSD-3-Clause
#include "app/replay.h"

#include <gtest/gtest.h>

#include "app/episode_files.h"
#include "app/placement.h"
#include "core/math/so3.h"
#include "core/robot/whole_body.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

TEST(Replay, ReproducesEveryEstimateBitForBit) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path();
  (void)RunToFolder(test::LoadScenario("rough", {"duration_s=6", "log.keep=full"}), options);
  const ReplayResult same = ReplayLog(folder.path() / "log.mcap", {});
  EXPECT_EQ(same.steps, 6000);
  EXPECT_EQ(same.rows, 3000);
  EXPECT_TRUE(same.identical) << same.first_difference_s;

  const ReplayResult other =
      ReplayLog(folder.path() / "log.mcap", {"controller.estimator.type=linear_kf"});
  EXPECT_FALSE(other.identical);
  EXPECT_NE(other.replayed.velocity_rmse_mps, other.logged.velocity_rmse_mps);
}

TEST(Placement, StandsOnAllFourFeetWithTheTrunkAlongTheGround) {
  const core::RobotDescription& robot = test::Go2();
  const terrains::Heightfield ground = test::TiltedGround(0.2, 0.8);
  const RobotState state = PlaceStanding(robot, ground, Vec2(0.3, -0.2), 0.0);
  EXPECT_NEAR(core::RpyFromRotation(state.R_WB).y(), -0.2, 0.01);
  for (const Leg leg : kLegs) {
    const Vec3 p_WF =
        state.p_WB + state.R_WB * core::CalcLegKinematics(robot.legs[leg], state.q[leg]).p_BF;
    const double clearance_m = (p_WF.z() - ground.HeightAt(p_WF.x(), p_WF.y())) * std::cos(0.2);
    EXPECT_NEAR(clearance_m, robot.legs[leg].foot_radius_m, 1e-3);
  }
}

}  // namespace
}  // namespace scoria::app
