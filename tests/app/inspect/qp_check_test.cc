// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/qp_check.h"

#include <fstream>

#include <gtest/gtest.h>

#include "app/run/run_scenario.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// Adds a number to one double of the file's first record (docs/qp_format.md).
void Disturb(const fs::path& path, int index, double by) {
  constexpr std::streamoff kHeaderBytes = 64;
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  const std::streamoff at = kHeaderBytes + 8 * index;
  double value = 0.0;
  file.seekg(at);
  file.read(reinterpret_cast<char*>(&value), 8);
  value += by;
  file.seekp(at);
  file.write(reinterpret_cast<const char*>(&value), 8);
}

TEST(QpCheck, SavedProblemsMeetTheirOptimalityConditionsAndDisturbedOnesDoNot) {
  const test::TemporaryFolder folder;
  const fs::path qps = folder.path() / "qps";
  RunOptions options;
  options.folder = folder.path() / "run";
  options.save_qps = qps;
  const Scenario scenario = test::LoadScenario("flat", {"duration_s=2", "log.keep=metrics"});
  (void)RunToFolder(scenario, options);
  for (const QpCheck& c : CheckQpSets(qps)) {
    EXPECT_GE(c.records, 20) << c.file;
    EXPECT_TRUE(c.Holds()) << c.file;
  }
  EXPECT_EQ(CheckQpSets(qps).size(), 2u);
  const int N = scenario.controller.mpc.horizon;
  const int q = 20 + 12 + N * (4 + 144 + 144 + 12) + 12 * (N + 1), g = 16 + 30 * 30;
  Disturb(qps / "mpc.bin", q, 10.0);
  Disturb(qps / "wbc.bin", g, 1.0);
  for (const QpCheck& c : CheckQpSets(qps)) EXPECT_FALSE(c.Holds()) << c.file;
}

}  // namespace
}  // namespace scoria::app
