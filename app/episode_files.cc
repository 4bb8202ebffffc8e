// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode_files.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <optional>

#include <nlohmann/json.hpp>

#include "analysis/terrain_view.h"
#include "app/qp_recorder.h"
#include "app/version.h"
#include "core/files.h"
#include "core/hash.h"
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

/// Episodes with equal ids walk the same ground.
std::string GroundId(const Scenario& scenario) {
  core::Hash64 hash;
  hash.Add(core::EmitYaml(core::WriteConfig(scenario.terrain)));
  hash.Add(fmt::format("{}", scenario.seed));
  return fmt::format("{:016x}", hash.value());
}

/// Points half a metre apart are enough to draw it.
nlohmann::json RouteToJson(const Route& route) {
  constexpr double kSpacing_m = 0.5;
  nlohmann::json json = nlohmann::json::array();
  std::optional<Vec2> last;
  for (const Vec2& p : route) {
    if (last && (p - *last).norm() < kSpacing_m) continue;
    json.push_back({std::round(100.0 * p.x()) / 100.0, std::round(100.0 * p.y()) / 100.0});
    last = p;
  }
  return json;
}

namespace fs = std::filesystem;

}  // namespace

EpisodeReport RunToFolder(const Scenario& scenario, const RunOptions& options) {
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  fs::create_directories(options.folder);
  fs::remove(options.folder / "result.json");  // an old result must not stand beside a new scenario
  core::WriteText(options.folder / "scenario.yaml", EffectiveYaml(scenario));
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  const nlohmann::json terrain =
      analysis::ToJson(terrains::MeasureTerrain(ground, scenario.terrain));

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
    if (kind == "fall") ++falls;
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
  for (const analysis::FallEvent& fall : report.result.fall_events) accumulator.AddFall(fall);
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
      {"ground", GroundId(scenario)},
      {"route", RouteToJson(r.route)},
      {"metrics", report.metrics}};
  core::WriteText(options.folder / "result.json.part", json.dump(2) + "\n");
  fs::rename(options.folder / "result.json.part",
             options.folder / "result.json");  // whole or not at all
  return report;
}

}  // namespace scoria::app
