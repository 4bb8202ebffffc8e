// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/placement.h"

#include <gtest/gtest.h>

#include "app/episode/function_observer.h"
#include "app/episode/operator.h"
#include "app/episode/run_episode.h"
#include "core/math/so3.h"
#include "core/rng.h"
#include "core/robot/whole_body.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

TEST(Placement, StandsOnAllFourFeetWithTheTrunkAlongTheGround) {
  const core::RobotDescription& robot = test::Go2();
  const terrains::Heightfield ground = test::TiltedGround(0.2, 0.8);
  const RobotState state = PlaceStanding(robot, ground, {Vec2(0.3, -0.2), 0.0});
  EXPECT_NEAR(core::RpyFromRotation(state.R_WB).y(), -0.2, 0.01);
  for (const Leg leg : kLegs) {
    const Vec3 p_WF =
        state.p_WB + state.R_WB * core::CalcLegKinematics(robot.legs[leg], state.q[leg]).p_BF;
    const double clearance_m = (p_WF.z() - ground.HeightAt(p_WF.x(), p_WF.y())) * std::cos(0.2);
    EXPECT_NEAR(clearance_m, robot.legs[leg].foot_radius_m, 1e-3);
  }
}

/// A boulder, a hemisphere of 0.25 m, on level ground at the origin.
terrains::Heightfield GroundWithBoulder() {
  constexpr int kNodes = 401;
  constexpr double kSpacing_m = 0.025, kRadius_m = 0.25;
  std::vector<double> heights;
  for (int row = 0; row < kNodes; ++row) {
    for (int column = 0; column < kNodes; ++column) {
      const double x = (column - kNodes / 2) * kSpacing_m, y = (row - kNodes / 2) * kSpacing_m;
      heights.push_back(std::sqrt(std::max(0.0, kRadius_m * kRadius_m - x * x - y * y)));
    }
  }
  return {kNodes, kSpacing_m, std::move(heights), {}};
}

TEST(Placement, MarginTellsBouldersSlopesAndLowFriction) {
  const core::RobotDescription& robot = test::Go2();
  const auto margin = [&](const terrains::Heightfield& ground, const Place& place) {
    return CalcStandingMargin(robot, ground, PlaceStanding(robot, ground, place));
  };
  EXPECT_GT(margin(test::FlatGround(), {}), 0.0);
  EXPECT_GT(margin(test::TiltedGround(0.2, 0.6), {}), 0.0);
  EXPECT_LT(margin(test::TiltedGround(0.2, 0.2), {}), 0.0) << "slides";
  EXPECT_LT(margin(test::TiltedGround(0.4, 0.9), {}), 0.0) << "steep";
  const terrains::Heightfield boulder = GroundWithBoulder();
  EXPECT_LT(margin(boulder, {}), 0.0) << "under the belly";
  EXPECT_LT(margin(boulder, {Vec2(-0.2, -0.14), 0.0}), 0.0) << "under the front left foot";
  EXPECT_GT(margin(boulder, {Vec2(-1.5, 0.0), 0.0}), 0.0);
}

TEST(Placement, ChoosesTheFirstGoodPlaceAndTheBestWhereThereIsNone) {
  const terrains::Heightfield ground = GroundWithBoulder();
  const Place bad{Vec2(0.0, 0.0), 0.0}, good{Vec2(1.5, 0.0), 0.0}, other{Vec2(2.0, 0.0), 0.0};
  EXPECT_EQ(ChoosePlace(test::Go2(), ground, std::vector{bad, good, other}).place.p_WB, good.p_WB);
  const terrains::Heightfield steep = test::TiltedGround(0.45, 0.9);
  const Place uphill{Vec2::Zero(), 0.0}, across{Vec2::Zero(), 1.5708};
  const ChosenPlace best = ChoosePlace(test::Go2(), steep, std::vector{uphill, across});
  const auto margin = [&](const Place& place) {
    return CalcStandingMargin(test::Go2(), steep, PlaceStanding(test::Go2(), steep, place));
  };
  EXPECT_LT(best.margin, 0.0);
  EXPECT_EQ(best.margin, std::max(margin(uphill), margin(across)));
}

// On a tile hardly wider than its loop, a robot that fell is put down on the loop beside its fall.
TEST(Placement, OnSmallTilesTheRobotIsPutBesideItsFall) {
  for (const double size_m : {6.0, 12.0}) {
    Scenario scenario = test::LoadScenario("flat", {"start=standing", "duration_s=12"});
    scenario.operation = RouteParams{};
    scenario.pushes = {{3.0, 0.1, 70.0, 1.5708}};
    std::vector<Vec2> falls, places;
    FunctionObserver observer;
    std::optional<Vec2> last_W;
    std::uint32_t segment = 0;
    observer.on_row = [&](const StepRecord&, const logs::Row& row) {
      const Vec2 p_WB(row.truth->p_WB_m[0], row.truth->p_WB_m[1]);
      if (last_W && row.episode->segment != segment) {
        falls.push_back(*last_W);
        places.push_back(p_WB);
      }
      last_W = p_WB;
      segment = row.episode->segment;
    };
    (void)RunEpisode(scenario, test::Go2(), test::FlatGround(0.8, size_m), {&observer});
    ASSERT_FALSE(falls.empty()) << size_m;
    const double loop_m = 0.5 * size_m - 2.0, off_loop_m = std::abs(falls.front().norm() - loop_m);
    EXPECT_LT((places.front() - falls.front()).norm(), off_loop_m + 0.7) << size_m;
  }
}

}  // namespace
}  // namespace scoria::app
