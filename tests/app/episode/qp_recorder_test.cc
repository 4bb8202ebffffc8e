// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/qp_recorder.h"

#include <gtest/gtest.h>

#include "app/run/run_scenario.h"
#include "controller/qp/sets/qp_check.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

TEST(QpRecorder, ProblemsOfAnEpisodeAreSavedWithOptimalSolutions) {
  const test::TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "run";
  options.save_qps = folder.path() / "qps";
  (void)RunToFolder(test::LoadScenario("flat", {"duration_s=2", "log.keep=metrics"}), options);
  const std::vector<controller::QpCheck> checks = controller::CheckQpFiles(options.save_qps);
  ASSERT_EQ(checks.size(), 2u);
  for (const controller::QpCheck& c : checks) {
    EXPECT_GE(c.records, 20) << c.file;
    EXPECT_TRUE(c.Holds()) << c.file;
  }
}

TEST(QpRecorder, ControllersWithoutProblemsAreRefusedBeforeAnythingIsWritten) {
  const test::TemporaryFolder folder;
  const fs::path qps = folder.path() / "qps";
  const auto complaint = [&](const controller::ControllerParams& params) -> std::string {
    try {
      const QpRecorder recorder(qps, params);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  };
  controller::ControllerParams threaded, other;
  threaded.mpc.threaded = true;
  other.wbc = controller::InverseDynamicsParams{};
  EXPECT_EQ(complaint(threaded), "--save-qps: controller.mpc.threaded must be false");
  EXPECT_EQ(complaint(other), "--save-qps: controller.wbc.type must be tsid");
  EXPECT_FALSE(fs::exists(qps));
}

}  // namespace
}  // namespace scoria::app
