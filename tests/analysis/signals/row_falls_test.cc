// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/row_falls.h"

#include <gtest/gtest.h>

#include "app/episode/function_observer.h"
#include "app/episode/run_episode.h"
#include "core/robot_files/load.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"
#include "tests/support/rows.h"
#include "tests/support/scenarios.h"

namespace scoria::analysis {
namespace {

// The simulator looks every step, the log has every second of them: the same falls, up to a row for
// the moment and one for the time that a limit must be exceeded apart.
TEST(RowFalls, AreThoseOfTheSimulator) {
  app::Scenario scenario = test::LoadScenario("flat", {"duration_s=14", "start=standing"});
  scenario.pushes = {{2.0, 0.1, 150.0, 1.5708}, {5.0, 0.1, 150.0, -1.5708}};
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  RowFalls truth(scenario.fall, robot.config.nominal_height_m, MotionSource::kTruth);
  RowFalls estimate(scenario.fall, robot.config.nominal_height_m, MotionSource::kEstimate);
  app::FunctionObserver observer;
  observer.on_row = [&](const app::StepRecord&, const logs::Row& row) {
    truth.Add(row);
    logs::Row field = row;
    test::DropTruth(field);
    estimate.Add(field);
  };
  const app::EpisodeResult result = app::RunEpisode(scenario, robot, ground, {&observer});
  ASSERT_EQ(result.falls, 2);
  ASSERT_EQ(truth.falls().size(), 2u);
  EXPECT_EQ(truth.source(), MotionSource::kTruth);
  const double row_s = 1.0 / scenario.controller.rates.wbc_Hz;
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(truth.falls()[i].time_s, result.fall_events[i].time_s, 2.0 * row_s);
    EXPECT_EQ(truth.falls()[i].cause, result.fall_events[i].cause);
    EXPECT_LT((*truth.falls()[i].p_WB - *result.fall_events[i].p_WB).norm(), 0.01);
  }
  EXPECT_EQ(estimate.source(), MotionSource::kEstimate);
  for (const FallEvent& fall : estimate.falls()) EXPECT_EQ(fall.cause, "tilt");
}

TEST(RowFalls, RowsWithoutTheSourceSayNothing) {
  logs::Row row = test::WholeRow();
  row.truth->rpy_rad[0] = row.estimate->rpy_rad[0] = 2.0;
  test::DropTruth(row);
  EXPECT_FALSE(FindFallSample(row, MotionSource::kTruth, 0.002).has_value());
  const auto sample = FindFallSample(row, MotionSource::kEstimate, 0.002);
  ASSERT_TRUE(sample.has_value());
  EXPECT_NEAR(sample->tilt_rad.value(), 2.0, 1e-12);
  EXPECT_FALSE(sample->height_m.has_value());
  EXPECT_FALSE(sample->trunk_force_N.has_value());
}

}  // namespace
}  // namespace scoria::analysis
