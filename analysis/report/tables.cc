// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/tables.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "core/files.h"

namespace scoria::analysis {
namespace {

/// A CSV field.
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

/// Name and value; none where it was not measured.
std::vector<std::pair<const char*, std::optional<double>>> EstimationNumbers(
    const EstimationMetrics& m) {
  const auto when = [](bool any, double value) {
    return any && std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  const DriftSummary d = SummariseDrift(m);
  const bool walked = m.present && d.segments > 0, rows = m.present && m.rows > 0;
  const bool short_way = m.present && m.rpe_1m.stretches > 0;
  const bool long_way = m.present && m.rpe_10m.stretches > 0;
  const ContactQuality& counted = m.contact.of(ContactWord::kCounted);
  const bool heard = m.contact.HasDetection();
  return {{"drift_horizontal_pct", when(walked, d.horizontal_pct)},
          {"drift_vertical_pct", when(walked, d.vertical_pct)},
          {"drift_yaw_deg_per_m", when(walked, d.yaw_deg_per_m)},
          {"rpe_1m_horizontal_m", when(short_way, m.rpe_1m.horizontal_rms_m)},
          {"rpe_1m_vertical_m", when(short_way, m.rpe_1m.vertical_rms_m)},
          {"rpe_10m_horizontal_m", when(long_way, m.rpe_10m.horizontal_rms_m)},
          {"rpe_10m_vertical_m", when(long_way, m.rpe_10m.vertical_rms_m)},
          {"est_velocity_rmse_mps", when(rows, m.velocity_rmse_mps)},
          {"est_roll_rmse_rad", when(rows, m.roll_rmse_rad)},
          {"est_pitch_rmse_rad", when(rows, m.pitch_rmse_rad)},
          {"nees_ratio", when(m.nees_rows > 0, m.nees_ratio)},
          {"nis_ratio", when(m.nis_dof > 0, m.nis_ratio)},
          {"contact_accuracy", when(heard, counted.Accuracy())},
          {"touchdown_delay_median_s", when(heard && counted.touchdown.delays.count() > 0,
                                            counted.touchdown.delays.Quantile(0.5))},
          {"sensor_auc", when(heard, m.contact.sensor.Area())},
          {"observer_auc", when(heard, m.contact.observer.Area())}};
}

/// All of the intervals of mass of an episode or of several.
std::vector<std::pair<const char*, std::optional<double>>> ModelNumbers(
    const std::vector<ModelMetrics>& models) {
  std::vector<ModelInterval> intervals;
  for (const ModelMetrics& m : models)
    intervals.insert(intervals.end(), m.intervals.begin(), m.intervals.end());
  const ModelSummary s = SummariseModel(intervals);
  const auto when = [](bool any, double value) {
    return any && std::isfinite(value) ? std::optional(value) : std::nullopt;
  };
  const bool judged = s.judged > 0, settled = s.settled > 0;
  return {{"model_bias_median_kg", when(settled, s.median_bias_kg)},
          {"model_bias_p95_kg", when(settled, s.p95_bias_kg)},
          {"model_rmse_median_kg", when(settled, s.median_rmse_kg)},
          {"model_settling_median_s", when(judged, s.median_settling_s)},
          {"model_com_x_rmse_median_m", when(settled, s.median_com_x_rmse_m)},
          {"model_com_y_rmse_median_m", when(settled, s.median_com_y_rmse_m)},
          {"model_settled_share",
           when(judged, static_cast<double>(s.settled) / static_cast<double>(s.judged))},
          {"model_used_bias_median_kg", when(s.used > 0, s.median_used_bias_kg)}};
}

}  // namespace

void WriteTables(const CampaignResults& results, const std::vector<Cell>& cells,
                 const std::filesystem::path& folder) {
  std::string csv = "id,arm";
  for (const Axis& axis : results.axes) csv += "," + Quoted(axis.key);
  csv +=
      ",seed,end,distance_m,falls,stuck,cot_mech_abs,cot_mech_pos,cot_electrical,cot_battery,"
      "velocity_rmse_mps,"
      "height_rmse_m,"
      "roll_rmse_rad,pitch_rmse_rad,mpc_median_s,mpc_p99_s,wbc_median_s,wbc_p99_s,real_time_"
      "factor";
  for (const auto& [name, value] : EstimationNumbers({})) csv += fmt::format(",{}", name);
  for (const auto& [name, value] : ModelNumbers({})) csv += fmt::format(",{}", name);
  csv += "\n";
  for (const EpisodeRecord& e : results.episodes) {
    const EpisodeMetrics& m = e.metrics;
    csv += Quoted(e.id) + "," + Quoted(e.arm);
    for (const std::string& value : e.point) csv += "," + Quoted(value);
    csv +=
        fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", e.seed, e.end,
                    m.distance_m, e.falls, e.stuck, m.cot_mech_abs, m.cot_mech_pos,
                    m.cot_electrical, m.cot_battery, m.tracking.velocity_rmse_mps,
                    m.tracking.height_rmse_m, m.tracking.roll_rmse_rad, m.tracking.pitch_rmse_rad,
                    m.mpc.median_s, m.mpc.p99_s, m.wbc.median_s, m.wbc.p99_s, e.real_time_factor);
    for (const auto& [name, value] : EstimationNumbers(m.estimation))
      csv += value ? fmt::format(",{}", *value) : ",";
    for (const auto& [name, value] : ModelNumbers({m.model}))
      csv += value ? fmt::format(",{}", *value) : ",";
    csv += "\n";
  }
  core::WriteText(folder / "metrics.csv", csv);

  nlohmann::json json = {{"name", results.name},
                         {"cells", nlohmann::json::array()},
                         {"comparisons", nlohmann::json::array()}};
  for (const Cell& c : cells) {
    json["cells"].push_back({{"arm", c.arm},
                             {"point", c.point},
                             {"metres", c.falls.exposure},
                             {"falls", c.falls.events},
                             {"falls_per_m", c.falls.rate},
                             {"falls_per_m_low", c.falls.interval.low},
                             {"falls_per_m_high", c.falls.interval.high},
                             {"cot_mech_abs", c.cot_mech_abs},
                             {"cot_mech_pos", c.cot_mech_pos},
                             {"cot_electrical", c.cot_electrical},
                             {"cot_battery", c.cot_battery},
                             {"stuck", c.stuck}});
    for (const auto& [name, value] : EstimationNumbers(c.estimation))
      json["cells"].back()["estimation"][name] = value ? nlohmann::json(*value) : nullptr;
    for (const auto& [name, value] : ModelNumbers(c.models))
      json["cells"].back()["model"][name] = value ? nlohmann::json(*value) : nullptr;
  }
  if (results.arms.size() > 1) {
    for (const Comparison& c : AllComparisons(results)) {
      json["comparisons"].push_back({{"a", c.a},
                                     {"b", c.b},
                                     {"point", c.point},
                                     {"ratio", c.ratio.ratio},
                                     {"low", c.ratio.interval.low},
                                     {"high", c.ratio.interval.high},
                                     {"p_value", c.ratio.p_value},
                                     {"dispersion", c.dispersion.index},
                                     {"verdict", c.verdict}});
    }
  }
  core::WriteText(folder / "metrics.json", JsonText(json));
}

}  // namespace scoria::analysis
