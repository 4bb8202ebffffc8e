// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/episode_files.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "analysis/terrain/terrain_view.h"
#include "app/episode/qp_recorder.h"
#include "app/run/inputs.h"
#include "app/run/robot_warnings.h"
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

void Warn(const Scenario& scenario, const core::RobotDescription& robot,
          const terrains::Terrain& terrain, const std::function<void(const std::string&)>& warn) {
  for (const std::string& w : WalkWarnings(robot, scenario.controller.mpc, scenario.gravity_mps2))
    warn(fmt::format("{}: {}", robot.config.name, w));
  for (const std::string& remark : terrains::HeightmapRemarks(terrain, scenario.terrain))
    warn(fmt::format("{}: {}", scenario.terrain.name, remark));
}

/// The way that the operator commands in the time that a robot has once it stands. One that never
/// stands was commanded it all the same.
double CommandedWay(const OperatorParams& operation, double duration_s) {
  constexpr double kStandUp_s = 3.0;
  const double walking_s = std::max(0.0, duration_s - kStandUp_s);
  if (const auto* route = std::get_if<RouteParams>(&operation))
    return std::min(route->distance_m, route->speed_mps * walking_s);
  const std::vector<VelocityStep>& steps = std::get<VelocityProgramme>(operation).steps;
  double way_m = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const double until_s =
        i + 1 < steps.size() ? std::min(steps[i + 1].at_s, walking_s) : walking_s;
    way_m +=
        std::hypot(steps[i].v_x_mps, steps[i].v_y_mps) * std::max(0.0, until_s - steps[i].at_s);
  }
  return way_m;
}

std::string DescribeFailure(const EpisodeResult& result, double commanded_m) {
  constexpr double kCommanded_m = 0.5, kWalked_m = 0.1;
  if (result.end == EpisodeEnd::kInterrupted) return "";
  if (result.end == EpisodeEnd::kNonFinite)
    return fmt::format("the state is not finite after {:.3f} s", result.duration_s);
  if (commanded_m > kCommanded_m && !(result.walked_m >= kWalked_m))
    return fmt::format("walked {:.2f} m where {:.2f} m were commanded", result.walked_m,
                       commanded_m);
  return "";
}

/// What an older run left must not stand beside the new one.
void RemoveOldRun(const std::filesystem::path& folder) {
  for (const char* name : {"result.json", "log.mcap", "report"})
    std::filesystem::remove_all(folder / name);
}

}  // namespace

EpisodeReport RunToFolder(const Scenario& scenario, const RunOptions& options) {
  const InputHashes inputs = InputHasher().Hash(scenario);  // before the files are read
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  if (!options.save_qps.empty() && !scenario.controller_changes.empty())
    throw std::runtime_error(
        "--save-qps: the scenario has controller_changes, the saved problems "
        "would not be of one kind");
  const terrains::Terrain made = terrains::MakeTerrain(scenario.terrain, scenario.seed, 0);
  const terrains::Heightfield& ground = made.ground;
  core::CreateFolders(options.folder);  // what is wrong with the input was told before
  RemoveOldRun(options.folder);
  core::WriteText(options.folder / "scenario.yaml", EffectiveYaml(scenario));
  if (options.on_warning) Warn(scenario, robot, made, options.on_warning);
  nlohmann::json terrain = analysis::ToJson(terrains::MeasureTerrain(ground, scenario.terrain));
  terrain["cut_nodes"] = made.cut_nodes;

  std::optional<FileSink> file;
  if (scenario.log.keep != KeepLog::kMetrics) {
    file.emplace(
        options.folder / "log.mcap", scenario, robot,
        logs::McapMetadata{{"version", kVersion}, {"terrain", analysis::JsonText(terrain)}});
  }
  analysis::MetricsAccumulator accumulator(scenario.gravity_mps2);
  int falls = 0;
  EpisodeSinks sinks;
  sinks.messages = file ? &*file : nullptr;
  sinks.interrupted = options.interrupted;
  sinks.on_row = [&](const logs::LogRow& row, const logs::SolveTimes& times) {
    accumulator.AddRow(row, times);
  };
  sinks.on_event = [&](double time_s, const std::string& kind, const std::string& detail) {
    if (kind == "fall") ++falls;
    if (options.on_event) options.on_event(time_s, kind, detail);
  };
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
  report.commanded_m = CommandedWay(scenario.operation, r.duration_s);
  report.failure = DescribeFailure(r, report.commanded_m);
  const double wall_s = r.times.sum(),
               simulated_s = std::max(r.duration_s, scenario.physics.step_s);
  report.real_time_factor = wall_s > 0.0 ? simulated_s / wall_s : 0.0;

  nlohmann::json json = {
      {"scenario", scenario.name},
      {"seed", scenario.seed},
      {"version", kVersion},
      {"inputs", inputs},
      {"end", core::EnumName(r.end)},
      {"falls", r.falls},
      {"stuck", r.stuck},
      {"walked_m", r.walked_m},
      {"commanded_m", report.commanded_m},
      {"message", report.failure},
      {"state_hash", fmt::format("{:016x}", r.state_hash)},
      {"counters", CountersToJson(r.counters)},
      {"unconverged_physics_steps", r.unconverged_steps},
      {"real_time_factor", report.real_time_factor},
      {"us_per_step", TimesToJson(r.times, scenario.physics.step_s / simulated_s * 1e6)},
      {"terrain", terrain},
      {"ground", terrains::GroundId(scenario.terrain, scenario.seed)},
      {"route", RouteToJson(r.route)},
      {"metrics", report.metrics}};
  core::WriteText(options.folder / "result.json", analysis::JsonText(json));
  return report;
}

}  // namespace scoria::app
