// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/draft_scenario.h"

#include <gtest/gtest.h>

#include "app/run/run_scenario.h"
#include "core/files.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

DraftScenarioOptions DraftOf(const fs::path& log, const fs::path& out) {
  const fs::path root = SCORIA_SOURCE_DIR;
  return {.input = {.log = log},
          .out = out,
          .terrains = root / "terrains",
          .controllers = root / "scenarios" / "controllers"};
}

/// Walks `scenario` with a log as the reference's recorder writes it, and drafts its twin.
std::string DraftTwin(const test::TemporaryFolder& folder, const Scenario& scenario) {
  RunOptions options;
  options.folder = folder.path() / "run";
  (void)RunToFolder(scenario, options);
  return DraftScenario(DraftOf(folder.path() / "run" / "log.mcap", folder.path() / "twin.yaml"));
}

TEST(DraftScenario, RepeatsCommandsAndGaitOfALogAsFromTheField) {
  const test::TemporaryFolder folder;
  const std::string text = DraftTwin(
      folder, test::LoadScenario(
                  "flat", {"duration_s=20", "log.topics=reference",
                           "operator={type: velocity, steps: [{at_s: 1, v_x_mps: 0.3}, {at_s: 12, "
                           "v_x_mps: 0.2, w_z_radps: 0.3}]}",
                           "controller.gait={type: sgs, gait: trot}"}));
  core::WriteText(folder.path() / "twin.yaml", text);
  const Scenario twin = LoadScenario(folder.path() / "twin.yaml", {});
  EXPECT_EQ(twin.name, "twin_of_log");
  EXPECT_EQ(twin.terrain.name, "flat") << text;
  const auto& steps = std::get<VelocityProgramme>(twin.operation).steps;
  const auto at = [&](double time_s) {
    VelocityStep now;
    for (const VelocityStep& step : steps) {
      if (step.at_s <= time_s) now = step;
    }
    return now;
  };
  EXPECT_EQ(at(0.5).v_x_mps, 0.0);
  EXPECT_NEAR(at(6.0).v_x_mps, 0.3, 1e-3);
  EXPECT_NEAR(at(15.0).v_x_mps, 0.2, 1e-3);
  EXPECT_NEAR(at(15.0).w_z_radps, 0.3, 1e-3);
  EXPECT_LT(steps.size(), 10u);
  const auto& sgs = std::get<controller::SgsParams>(twin.controller.gait);
  const auto trot = controller::TimingOf(controller::NamedGait::kTrot);
  EXPECT_NEAR(*sgs.period_s, trot.period_s, 1e-3);
  EXPECT_NEAR(*sgs.duty, trot.duty, 1e-3);
  EXPECT_NE(text.find("Not known: gains and weights"), std::string::npos);
  EXPECT_NE(text.find("By the torques, untared, the robot weighs"), std::string::npos);
}

TEST(DraftScenario, TakesTheAdaptiveSequencerAndRoughGround) {
  const test::TemporaryFolder folder;
  const std::string text =
      DraftTwin(folder, test::LoadScenario("rough", {"duration_s=60", "log.topics=reference"}));
  core::WriteText(folder.path() / "twin.yaml", text);
  const Scenario twin = LoadScenario(folder.path() / "twin.yaml", {});
  EXPECT_TRUE(std::holds_alternative<controller::AgsParams>(twin.controller.gait)) << text;
  EXPECT_NE(twin.terrain.name, "flat") << text;
  EXPECT_NEAR(twin.terrain.roughness_scale, 0.8, 0.25) << "the route goes round the roughest";
  EXPECT_GT(twin.controller.swing.apex_m, 0.05);
  EXPECT_LT(twin.controller.swing.apex_m, 0.15);
}

}  // namespace
}  // namespace scoria::app
