// SPDX-License-Identifier: BSD-3-Clause
// Closed-loop claims on short episodes; docs/results holds the long ones.
#include <gtest/gtest.h>

#include "analysis/metrics.h"
#include "app/runner.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

struct Outcome {
  EpisodeResult result;
  analysis::EpisodeMetrics metrics;
};

Outcome Walk(const Scenario& scenario) {
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  analysis::MetricsAccumulator accumulator(scenario.gravity_mps2);
  EpisodeSinks sinks;
  sinks.on_row = [&](const core::LogRow& row, const core::SolveTimes& times) {
    accumulator.AddRow(row, times);
  };
  Outcome out;
  out.result = RunEpisode(scenario, robot, ground, sinks);
  out.metrics = accumulator.Finish();
  return out;
}

struct Case {
  const char* gait;
  double v_x, v_y, w_z;
};

class FlatGround : public ::testing::TestWithParam<Case> {};

TEST_P(FlatGround, WalksAsCommanded) {
  const Case c = GetParam();
  Scenario scenario =
      test::LoadScenario("flat", {std::string("controller.gait.type=") + c.gait, "duration_s=15"});
  scenario.operation = VelocityProgramme{{{0.0, c.v_x, c.v_y, c.w_z}}};
  const Outcome o = Walk(scenario);
  EXPECT_EQ(o.result.falls, 0);
  EXPECT_EQ(o.result.counters.mpc_failures + o.result.counters.wbc_failures, 0u);
  const analysis::TrackingErrors& t = o.metrics.tracking;
  EXPECT_NEAR(t.velocity_x_mps, c.v_x, 0.03 * std::abs(c.v_x) + 0.01);
  EXPECT_NEAR(t.velocity_y_mps, c.v_y, 0.03 * std::abs(c.v_y) + 0.01);
  EXPECT_NEAR(t.yaw_rate_radps, c.w_z, 0.03 * std::abs(c.w_z) + 0.01);
  EXPECT_LT(t.velocity_rmse_mps, std::max(std::abs(c.v_x), std::abs(c.v_y)) > 0.5 ? 0.08 : 0.04);
  EXPECT_LT(t.height_rmse_m, 0.012);
  EXPECT_LT(t.roll_rmse_rad, 0.0175);
  EXPECT_LT(t.pitch_rmse_rad, 0.0175);
}

INSTANTIATE_TEST_SUITE_P(
    Gaits, FlatGround,
    ::testing::Values(Case{"ags", 0.1, 0, 0}, Case{"ags", 0.5, 0, 0}, Case{"ags", 1.0, 0, 0},
                      Case{"ags", 0, 0.3, 0}, Case{"ags", 0, 0, 0.8}, Case{"sgs", 0.1, 0, 0},
                      Case{"sgs", 0.5, 0, 0}, Case{"sgs", 1.0, 0, 0}, Case{"sgs", 0, 0.3, 0},
                      Case{"sgs", 0, 0, 0.8}, Case{"sgs_matched", 0.5, 0, 0}),
    [](const auto& test_info) {
      const Case& c = test_info.param;
      std::string name = fmt::format("{}_x{}_y{}_yaw{}", c.gait, c.v_x, c.v_y, c.w_z);
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

TEST(Standing, DoesNotDrift) {
  const Outcome o = Walk(test::LoadScenario("flat", {"operator.steps=[]", "duration_s=20"}));
  EXPECT_EQ(o.result.falls, 0);
  EXPECT_LT(o.metrics.tracking.drift_m, 0.005);
}

TEST(Rough, WalksSixMetresForEveryGaitAndLateContactOption) {
  for (const char* gait : {"ags", "sgs", "sgs_matched"}) {
    for (const char* late : {"stance", "lower"}) {
      const Outcome o = Walk(
          test::LoadScenario("rough", {std::string("controller.gait.type=") + gait,
                                       std::string("controller.legs.late_contact=") + late,
                                       "operator.distance_m=6", "terrain.roughness_scale=0.5"}));
      EXPECT_EQ(o.result.end, EpisodeEnd::kCompleted) << gait << " " << late;
      EXPECT_EQ(o.result.falls, 0) << gait << " " << late;
    }
  }
}

TEST(Recovery, FallenRobotIsSetOnItsFeetAndWalksOn) {
  Scenario scenario = test::LoadScenario("flat", {"duration_s=14"});
  scenario.pushes = {{2.0, 0.1, Vec3(0.0, 900.0, 0.0)}};  // far beyond what anyone survives
  const Outcome o = Walk(scenario);
  EXPECT_EQ(o.result.falls, 1);
  EXPECT_EQ(o.result.end, EpisodeEnd::kCompleted);
  EXPECT_GT(o.metrics.distance_m, 1.5) << "it walked again afterwards";
}

TEST(Push, TenNewtonSecondsFromTheSideAreSurvived) {
  for (const char* gait : {"ags", "sgs"}) {
    Scenario scenario =
        test::LoadScenario("flat", {std::string("controller.gait.type=") + gait, "duration_s=10"});
    scenario.pushes = {{4.0, 0.1, Vec3(0.0, 100.0, 0.0)}};  // 10 N s
    EXPECT_EQ(Walk(scenario).result.falls, 0) << gait;
  }
}

}  // namespace
}  // namespace scoria::app
