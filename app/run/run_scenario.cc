// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/run_scenario.h"

#include <algorithm>
#include <optional>

#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "analysis/terrain/terrain_view.h"
#include "app/episode/function_observer.h"
#include "app/episode/qp_recorder.h"
#include "app/episode/record.h"
#include "app/episode/run_episode.h"
#include "app/run/inputs.h"
#include "app/run/result_json.h"
#include "app/run/robot_warnings.h"
#include "app/run/walk_check.h"
#include "app/version.h"
#include "core/files.h"
#include "core/robot_files/load.h"
#include "terrains/generator.h"

namespace scoria::app {
namespace {

void Warn(const Scenario& scenario, const core::RobotDescription& robot,
          const terrains::Terrain& terrain, const std::function<void(const std::string&)>& warn) {
  for (const std::string& w : WalkWarnings(robot, ConditionsOf(scenario, robot)))
    warn(fmt::format("{}: {}", robot.config.name, w));
  for (const std::string& w : TareWarnings(scenario)) warn(w);
  for (const std::string& remark : terrains::HeightmapRemarks(terrain, scenario.terrain))
    warn(fmt::format("{}: {}", scenario.terrain.name, remark));
}

/// What an older run left must not stand beside the new one.
void RemoveOldRun(const std::filesystem::path& folder) {
  for (const char* name : {"result.json", "log.mcap", "report"})
    std::filesystem::remove_all(folder / name);
}

/// One run: its robot and ground, and who looks on.
class ScenarioRun {
 public:
  ScenarioRun(const Scenario& scenario, const RunOptions& options)
      : scenario_(scenario),
        options_(options),
        inputs_(InputHasher().Hash(scenario)),  // before the files are read
        robot_(core::LoadRobot(scenario.robot)),
        terrain_(terrains::MakeTerrain(scenario.terrain, scenario.seed, 0)),
        metrics_(scenario.gravity_mps2) {
    metrics_rows_.on_row = [this](const StepRecord&, const logs::Row& row) {
      metrics_.AddRow(row);
    };
    progress_.on_step = [this](const StepRecord& record) {
      constexpr int kEvery = 250;
      if (options_.on_progress && record.step % kEvery == 0)
        options_.on_progress(record.time_s, falls_);
    };
    progress_.on_event = [this](const EpisodeEvent& event) {
      if (event.kind == "fall") ++falls_;
      ++events_[event.kind];
      if (options_.on_event) options_.on_event(event.time_s, event.kind, event.detail);
    };
    observers_ = {&metrics_rows_, &progress_};
  }

  EpisodeReport Run() {
    PrepareFolder();
    OpenLog();
    SaveQps();
    EpisodeReport report;
    report.result =
        RunEpisode(scenario_, robot_, terrain_.ground, observers_, options_.interrupted);
    for (const analysis::FallEvent& fall : report.result.fall_events) metrics_.AddFall(fall);
    report.metrics = metrics_.Finish();
    report.events = events_;
    if (file_) file_->Close();
    if (qps_) qps_->Close();
    Judge(report);
    WriteResult(report);
    return report;
  }

 private:
  void PrepareFolder() {
    core::CreateFolders(options_.folder);  // what is wrong with the input was told before
    RemoveOldRun(options_.folder);
    core::WriteText(options_.folder / "scenario.yaml", EffectiveYaml(scenario_));
    if (options_.on_warning) Warn(scenario_, robot_, terrain_, options_.on_warning);
    terrain_json_ = analysis::ToJson(terrains::MeasureTerrain(terrain_.ground, scenario_.terrain));
    terrain_json_["cut_nodes"] = terrain_.cut_nodes;
  }

  void OpenLog() {
    if (scenario_.log.keep == KeepLog::kMetrics) return;
    file_.emplace(
        options_.folder / "log.mcap", scenario_, robot_,
        logs::LogMetadata{{"version", kVersion}, {"terrain", analysis::JsonText(terrain_json_)}});
    observers_.push_back(&recorder_.emplace(*file_, scenario_));
  }

  void SaveQps() {
    if (options_.save_qps.empty()) return;
    observers_.push_back(&qps_.emplace(options_.save_qps, scenario_.controller));
  }

  void Judge(EpisodeReport& report) const {
    const EpisodeResult& r = report.result;
    report.commanded_m = CommandedWay(scenario_.operation, r.duration_s);
    report.failure = DescribeFailure(r, report.commanded_m);
    const double wall_s = r.times.sum();
    report.simulated_s = std::max(r.duration_s, scenario_.physics.step_s);
    report.real_time_factor = wall_s > 0.0 ? report.simulated_s / wall_s : 0.0;
    report.metrics.outcome = {r.falls, r.stuck, report.real_time_factor};
  }

  void WriteResult(const EpisodeReport& report) const {
    nlohmann::json json = ResultToJson(report, scenario_);
    json["inputs"] = inputs_;
    json["terrain"] = terrain_json_;
    core::WriteText(options_.folder / "result.json", analysis::JsonText(json));
  }

  const Scenario& scenario_;
  const RunOptions& options_;
  InputHashes inputs_;
  core::RobotDescription robot_;
  terrains::Terrain terrain_;
  nlohmann::json terrain_json_;
  analysis::MetricsAccumulator metrics_;
  FunctionObserver metrics_rows_, progress_;
  std::optional<FileSink> file_;
  std::optional<Recorder> recorder_;
  std::optional<QpRecorder> qps_;
  std::vector<EpisodeObserver*> observers_;
  int falls_ = 0;
  std::map<std::string, int> events_;  // by kind
};

}  // namespace

EpisodeReport RunToFolder(const Scenario& scenario, const RunOptions& options) {
  if (!options.save_qps.empty() && !scenario.controller_changes.empty())
    throw std::runtime_error(
        "--save-qps: the scenario has controller_changes, the saved problems "
        "would not be of one kind");
  return std::make_unique<ScenarioRun>(scenario, options)->Run();
}

}  // namespace scoria::app
