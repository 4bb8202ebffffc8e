// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/replay.h"

#include <gtest/gtest.h>

#include "app/run/run_scenario.h"
#include "tests/support/logs.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

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

// The estimates are the controller's own: they can be compared without knowing the truth.
TEST(Replay, NeedsNoTruth) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path();
  (void)RunToFolder(test::LoadScenario("rough", {"duration_s=3"}), options);
  const std::filesystem::path log = folder.path() / "field.mcap";
  test::CopyLog(folder.path() / "log.mcap", log,
                [](const std::string& topic) { return !test::IsTruthTopic(topic); });
  const ReplayResult same = ReplayLog(log, {});
  EXPECT_EQ(same.rows, 1500);
  EXPECT_TRUE(same.identical) << same.first_difference_s;
  EXPECT_EQ(same.file_problem, "");
  EXPECT_EQ(same.replayed.rows, 0u) << "no error is known";
}

TEST(Replay, FollowsFallsAndChangesOfTheController) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path();
  Scenario scenario = test::LoadScenario("flat", {"duration_s=9", "start=standing"});
  scenario.controller_changes = {{1.0, {"gait.type=sgs", "mpc.horizon=20"}}};
  scenario.pushes = {{2.0, 0.1, 150.0, 1.5708}};
  scenario.controller.adaptation = controller::KfPlusParams{};
  const EpisodeReport report = RunToFolder(scenario, options);
  EXPECT_GT(report.result.falls, 0) << "the push is meant to fell it";
  const ReplayResult same = ReplayLog(folder.path() / "log.mcap", {});
  EXPECT_EQ(same.steps, 9000);
  EXPECT_TRUE(same.identical) << same.first_difference_s;
}

TEST(Replay, PlaysTheSolverFaultsOfTheLog) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path();
  (void)RunToFolder(
      test::LoadScenario("rough",
                         {"duration_s=6", "solver_faults.share=0.05",
                          "solver_faults.outages=[{at_s: 3, duration_s: 0.5, solver: mpc}]"}),
      options);
  const ReplayResult same = ReplayLog(folder.path() / "log.mcap", {});
  EXPECT_EQ(same.steps, 6000);
  EXPECT_TRUE(same.identical) << same.first_difference_s;
}

std::string ReplayError(const std::filesystem::path& log, const std::vector<std::string>& set) {
  try {
    (void)ReplayLog(log, set);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(Replay, SaysWhatItCannotDo) {
  const test::TemporaryFolder folder;
  const std::filesystem::path log = folder.path() / "log.mcap";
  RunOptions options;
  options.folder = folder.path();
  (void)RunToFolder(test::LoadScenario("flat", {"duration_s=1", "controller.estimator.type=truth"}),
                    options);
  EXPECT_EQ(
      ReplayError(log, {}),
      log.string() +
          ": a controller that runs on the truth cannot be replayed; choose other stages "
          "with --set controller.estimator.type=inekf and controller.contact.source=hierarchy");
  (void)RunToFolder(test::LoadScenario("flat", {"duration_s=1"}), options);
  const std::filesystem::path silent = folder.path() / "silent.mcap";
  test::CopyLog(log, silent, [](const std::string& t) { return t != "/scoria/row/estimate"; });
  EXPECT_EQ(ReplayError(silent, {}), "the log holds no estimates to compare with");
  EXPECT_NE(ReplayError(log, {"gravity_mps2=3.7"}).find("a replay can only change controller.*"),
            std::string::npos);
}

}  // namespace
}  // namespace scoria::app
