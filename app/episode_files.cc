// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode_files.h"

#include <algorithm>
#include <fstream>
#include <optional>

#include <nlohmann/json.hpp>

#include "analysis/terrain_view.h"
#include "app/qp_recorder.h"
#include "app/robot_warnings.h"
#include "app/version.h"
#include "core/files.h"
#include "terrains/generator.h"

namespace scoria::app {
namespace {

nlohmann::json TimesToJson(const core::StageTimes& times, double scale) {
  nlohmann::json json;
  for (const auto& [stage, name] : EnumNames(core::Stage{})) json[name] = times[stage] * scale;
  return json;
}

nlohmann::json CountersToJson(const Counters& counters) {
  nlohmann::json json;
  for (const auto& [what, name] : EnumNames(Count{})) json[name] = counters[what];
  return json;
}

void Warn(const Scenario& scenario, const core::RobotDescription& robot,
          const terrains::Terrain& terrain, const std::function<void(const std::string&)>& warn) {
  for (const std::string& w : WalkWarnings(robot, scenario.controller.mpc, scenario.gravity_mps2))
    warn(fmt::format("{}: {}", robot.config.name, w));
  for (const std::string& remark : terrains::HeightmapRemarks(terrain, scenario.terrain))
    warn(fmt::format("{}: {}", scenario.terrain.name, remark));
}

namespace fs = std::filesystem;

}  // namespace

EpisodeReport RunToFolder(const Scenario& scenario, const RunOptions& options) {
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  fs::create_directories(options.folder);
  fs::remove(options.folder / "result.json");  // an old result must not stand beside a new scenario
  core::WriteText(options.folder / "scenario.yaml", EffectiveYaml(scenario));
  const terrains::Terrain made = terrains::MakeTerrain(scenario.terrain, scenario.seed, 0);
  const terrains::Heightfield& ground = made.ground;
  if (options.on_warning) Warn(scenario, robot, made, options.on_warning);
  nlohmann::json terrain = analysis::ToJson(terrains::MeasureTerrain(ground, scenario.terrain));
  terrain["cut_nodes"] = made.cut_nodes;

  std::optional<FileSink> file;
  if (scenario.log.keep != KeepLog::kMetrics) {
    file.emplace(options.folder / "log.mcap", scenario, robot.urdf_text,
                 core::McapMetadata{{"version", kVersion}, {"terrain", terrain.dump()}});
  }
  analysis::MetricsAccumulator accumulator(scenario.gravity_mps2);
  int falls = 0;
  EpisodeSinks sinks;
  sinks.messages = file ? &*file : nullptr;
  sinks.interrupted = options.interrupted;
  sinks.on_row = [&](const core::LogRow& row, const core::SolveTimes& times) {
    accumulator.AddRow(row, times);
  };
  sinks.on_event = [&](double time_s, const std::string& kind, const std::string& detail) {
    if (kind == "fall") {
      ++falls;
      accumulator.AddFall(time_s, detail);
    }
    if (options.on_event) options.on_event(time_s, kind, detail);
  };
  if (!options.save_qps.empty() && !scenario.controller_changes.empty())
    throw std::runtime_error(
        "--save-qps: the scenario has controller_changes, the saved problems "
        "would not be of one kind");
  std::optional<QpRecorder> qps;
  if (!options.save_qps.empty()) {
    qps.emplace(options.save_qps, scenario.controller);
    sinks.on_control = [&](const controller::Controller& controller,
                           const controller::ControlOutput& out) { qps->Record(controller, out); };
  }
  if (options.on_progress)
    sinks.on_progress = [&](double time_s) { options.on_progress(time_s, falls); };

  EpisodeReport report;
  report.result = RunEpisode(scenario, robot, ground, sinks);
  report.metrics = accumulator.Finish();
  if (file) file->Close();
  const EpisodeResult& r = report.result;
  const double wall_s = r.times.sum(),
               simulated_s = std::max(r.duration_s, scenario.physics.step_s);
  report.real_time_factor = wall_s > 0.0 ? simulated_s / wall_s : 0.0;

  nlohmann::json json = {
      {"scenario", scenario.name},
      {"seed", scenario.seed},
      {"version", kVersion},
      {"end", core::EnumName(r.end)},
      {"falls", r.falls},
      {"stuck", r.stuck},
      {"walked_m", r.walked_m},
      {"state_hash", fmt::format("{:016x}", r.state_hash)},
      {"counters", CountersToJson(r.counters)},
      {"unconverged_physics_steps", r.unconverged_steps},
      {"real_time_factor", report.real_time_factor},
      {"us_per_step", TimesToJson(r.times, scenario.physics.step_s / simulated_s * 1e6)},
      {"terrain", terrain},
      {"metrics", report.metrics}};
  core::WriteText(options.folder / "result.json.part", json.dump(2) + "\n");
  fs::rename(options.folder / "result.json.part",
             options.folder / "result.json");  // whole or not at all
  return report;
}

}  // namespace scoria::app
