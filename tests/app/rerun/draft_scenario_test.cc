// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/draft_scenario.h"

#include <cmath>

#include <gtest/gtest.h>

#include "app/rerun/read_friction.h"
#include "app/run/run_scenario.h"
#include "core/files.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = SCORIA_SOURCE_DIR;

/// A folder of two presets: to measure all takes a minute.
fs::path TwoTerrains(const test::TemporaryFolder& folder) {
  const fs::path terrains = folder.path() / "terrains";
  fs::create_directory(terrains);
  for (const char* name : {"flat.yaml", "self_affine.yaml"})
    fs::copy_file(kRoot / "terrains" / name, terrains / name);
  return terrains;
}

/// Walks `scenario` with a log as the reference's recorder writes it, and drafts its twin.
std::string DraftTwin(const test::TemporaryFolder& folder, const Scenario& scenario,
                      bool walks = false) {
  RunOptions options;
  options.folder = folder.path() / "run";
  (void)RunToFolder(scenario, options);
  return DraftScenario({.input = {.log = folder.path() / "run" / "log.mcap"},
                        .out = folder.path() / "twin.yaml",
                        .terrains = TwoTerrains(folder),
                        .controllers = kRoot / "scenarios" / "controllers",
                        .walks = walks});
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
  EXPECT_NE(text.find("Not known: friction"), std::string::npos);
}

/// The turns that were walked, not those that were commanded.
TEST(DraftScenario, TellsTheHeadingsThatWereWalked) {
  const test::TemporaryFolder folder;
  const std::string text = DraftTwin(
      folder, test::LoadScenario("flat", {"duration_s=12", "log.topics=reference",
                                          "operator={type: velocity, steps: [{at_s: 1, v_x_mps: "
                                          "0.2, w_z_radps: 0.5}, {at_s: 9, v_x_mps: 0.2}]}"}));
  core::WriteText(folder.path() / "twin.yaml", text);
  const Scenario twin = LoadScenario(folder.path() / "twin.yaml", {});
  const auto& steps = std::get<VelocityProgramme>(twin.operation).steps;
  EXPECT_NEAR(steps.front().heading_rad.value(), 0.0, 0.02) << text;
  EXPECT_NEAR(steps.back().heading_rad.value(), 4.0, 0.4) << "over pi\n" << text;
}

TEST(DraftScenario, ReadsTheFrictionByWalksOfItsOwn) {
  const test::TemporaryFolder folder;
  const std::string text =
      DraftTwin(folder,
                test::LoadScenario("rough", {"duration_s=20", "seed=5", "log.topics=reference",
                                             "terrain.substrate.friction=0.3"}),
                true);
  core::WriteText(folder.path() / "twin.yaml", text);
  const Scenario twin = LoadScenario(folder.path() / "twin.yaml", {});
  EXPECT_NEAR(twin.terrain.substrate.friction, 0.3, 0.08) << text;
}

TEST(ReadFriction, LiesBetweenThoseThatWereWalked) {
  const std::vector<SlipOnFriction> walked = {{0.2, 0.1}, {0.4, 0.03}, {0.8, 0.02}};
  EXPECT_NEAR(ReadFriction(walked, 0.03).value(), 0.4, 1e-9);
  EXPECT_NEAR(ReadFriction(walked, std::sqrt(0.1 * 0.03)).value(), std::sqrt(0.2 * 0.4), 1e-9);
  EXPECT_LT(ReadFriction(walked, 0.2).value(), 0.2) << "more than on any";
  EXPECT_GT(ReadFriction(walked, 0.015).value(), 0.8) << "less than on any";
}

TEST(ReadFriction, TellsNothingWhereFrictionsSlipAlike) {
  EXPECT_FALSE(ReadFriction({{0.2, 0.1}, {0.4, 0.021}, {0.8, 0.02}}, 0.0205));
  EXPECT_FALSE(ReadFriction({{0.2, 0.02}, {0.4, 0.03}}, 0.025)) << "no friction slips like this";
  EXPECT_FALSE(ReadFriction({{0.2, 0.1}}, 0.1)) << "one alone has no slope";
  EXPECT_FALSE(ReadFriction({}, 0.1));
}

}  // namespace
}  // namespace scoria::app
