// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/result_json.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "analysis/metrics/registry.h"
#include "app/version.h"
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

}  // namespace

nlohmann::json ResultToJson(const EpisodeReport& report, const Scenario& scenario) {
  const EpisodeResult& r = report.result;
  const analysis::Metrics all = analysis::AllMetrics();
  nlohmann::json metrics = report.metrics;
  metrics["scalars"] = analysis::ToJson(all, analysis::ValuesOf(all, report.metrics));
  const double per_step_us = scenario.physics.step_s / report.simulated_s * 1e6;
  return {{"scenario", scenario.name},
          {"seed", scenario.seed},
          {"version", kVersion},
          {"engine", sim::EngineName(scenario.physics.engine)},
          {"end", core::EnumName(r.end)},
          {"falls", r.falls},
          {"stuck", r.stuck},
          {"walked_m", r.walked_m},
          {"commanded_m", report.commanded_m},
          {"message", report.failure},
          {"state_hash", fmt::format("{:016x}", r.state_hash)},
          {"counters", CountersToJson(r.counters)},
          {"events", report.events},
          {"unconverged_physics_steps", r.unconverged_steps},
          {"real_time_factor", report.real_time_factor},
          {"us_per_step", TimesToJson(r.times, per_step_us)},
          {"ground", terrains::GroundId(scenario.terrain, scenario.seed)},
          {"route", RouteToJson(r.route)},
          {"metrics", metrics}};
}

}  // namespace scoria::app
