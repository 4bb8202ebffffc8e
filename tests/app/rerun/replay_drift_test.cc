// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "app/rerun/replay_variants.h"
#include "app/run/run_scenario.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

TEST(ReplayDrift, OnRoughGroundTheFilterDriftsAThirdOfTheLegsAtMost) {
  for (const int seed : {1, 2, 3}) {
    SCOPED_TRACE(seed);
    const test::TemporaryFolder folder;
    RunOptions options;
    options.folder = folder.path();
    (void)RunToFolder(
        test::LoadScenario("rough", {"duration_s=90", "seed=" + std::to_string(seed)}), options);
    const ReplayReport report =
        ReplayVariants({.log = folder.path() / "log.mcap"},
                       {{"inekf", {"controller.estimator.type=inekf"}},
                        {"legs", {"controller.estimator.type=leg_odometry"}}},
                       {}, 2);
    const auto drift = [&](std::size_t i) {
      return analysis::SummariseDrift(report.variants[i].estimation).horizontal_pct;
    };
    EXPECT_LT(3.0 * drift(0), drift(1));
  }
}

}  // namespace
}  // namespace scoria::app
