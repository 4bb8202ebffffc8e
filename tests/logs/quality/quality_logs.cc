// SPDX-License-Identifier: BSD-3-Clause
#include "tests/logs/quality/quality_logs.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "logs/mapping/any_rows.h"
#include "logs/quality/judge.h"
#include "tests/support/go1_log.h"
#include "tests/support/mini_cheetah.h"
#include "tests/support/robots.h"
#include "tests/support/rows.h"
#include "tests/support/scenarios.h"
#include "tests/support/walk.h"

namespace scoria::test {

namespace fs = std::filesystem;

CleanLog WalkOfGo2(const std::string& scenario_name, int seed) {
  app::Scenario scenario =
      LoadScenario(scenario_name, {"duration_s=9", fmt::format("seed={}", seed)});
  if (scenario_name == "flat") {
    const double side = seed % 2 == 0 ? 1.0 : -1.0;
    scenario.operation =
        app::VelocityProgramme{{{0.0, 0.2 + 0.05 * seed, 0.05 * side, 0.3 * side}}};
    scenario.start = app::StartPose::kStanding;
  }
  constexpr double kStart_s = 2.0;  // of walking
  CleanLog log;
  log.name = fmt::format("go2_{}_{}", scenario_name, seed);
  log.robot = std::make_shared<core::RobotDescription>(Go2());
  (void)Walk(scenario, [&](const logs::Row& row) {
    if (row.time_s < kStart_s) return;
    logs::Row field = row;
    DropTruth(field);
    log.rows.push_back(field);
  });
  return log;
}

CleanLog Go1Log() {
  return {"go1_sim_trot_mpi", ReadRecordedLog({"go1_sim_trot_mpi/go1_trot_1khz.csv"}),
          std::make_shared<core::RobotDescription>(LoadGo1(*Go1Folder()))};
}

CleanLog MiniCheetahLog() {
  return {"minicheetah_raisim", ReadRecordedLog({"minicheetah_raisim/flat_fwd_minus_0_4.csv"}),
          std::make_shared<core::RobotDescription>(MakeMiniCheetah())};
}

std::optional<fs::path> RecordedLog(const std::string& name) {
  const char* root = std::getenv("SCORIA_REFERENCE_DATA");
  if (root == nullptr) return std::nullopt;
  return fs::path(root) / "logs" / name;
}

std::vector<logs::Row> ReadRecordedLog(const std::vector<std::string>& names,
                                       const std::string& mapping_text) {
  std::vector<fs::path> paths;
  for (const std::string& name : names) paths.push_back(*RecordedLog(name));
  const TemporaryFolder folder;
  logs::RowsOptions options;
  if (!mapping_text.empty()) {
    const fs::path file = folder.path() / "mapping.yaml";
    std::ofstream(file) << mapping_text;
    options.mapping = file.string();
  }
  std::vector<logs::Row> rows;
  (void)logs::ForEachRow(paths, options, [&](const logs::Row& row) { rows.push_back(row); });
  return rows;
}

std::vector<logs::Row> Window(const std::vector<logs::Row>& rows, int place) {
  constexpr double kLength_s = 6.0;
  const double spare_s = rows.back().time_s - rows.front().time_s - kLength_s;
  const double begin_s = rows.front().time_s + std::max(0.0, spare_s) * place / 9.0;
  std::vector<logs::Row> window;
  for (const logs::Row& row : rows) {
    if (row.time_s >= begin_s && row.time_s <= begin_s + kLength_s) window.push_back(row);
  }
  return window;
}

std::vector<logs::Finding> Judge(const std::vector<logs::Row>& rows,
                                 const core::RobotDescription* robot) {
  return logs::JudgeLog(
      [&](const std::function<void(const logs::Row&)>& on_row) {
        for (const logs::Row& row : rows) on_row(row);
      },
      {.robot = robot});
}

}  // namespace scoria::test
