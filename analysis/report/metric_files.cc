// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/metric_files.h"

#include <array>
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

using nlohmann::json;

/// A number of an episode or a cell under its key.
template <class Source>
struct NumberOf {
  const char* key;
  double (*value)(const Source& source);
};

/// Between the end of an episode and what was estimated.
constexpr std::array<NumberOf<EpisodeRecord>, 16> kEpisodeNumbers = {{
    {"distance_m", [](const EpisodeRecord& e) { return e.metrics.distance_m; }},
    {"falls", [](const EpisodeRecord& e) { return static_cast<double>(e.falls); }},
    {"stuck", [](const EpisodeRecord& e) { return static_cast<double>(e.stuck); }},
    {"cot_mech_abs", [](const EpisodeRecord& e) { return e.metrics.cot_mech_abs; }},
    {"cot_mech_pos", [](const EpisodeRecord& e) { return e.metrics.cot_mech_pos; }},
    {"cot_electrical", [](const EpisodeRecord& e) { return e.metrics.cot_electrical; }},
    {"cot_battery", [](const EpisodeRecord& e) { return e.metrics.cot_battery; }},
    {"velocity_rmse_mps",
     [](const EpisodeRecord& e) { return e.metrics.tracking.velocity_rmse_mps; }},
    {"height_rmse_m", [](const EpisodeRecord& e) { return e.metrics.tracking.height_rmse_m; }},
    {"roll_rmse_rad", [](const EpisodeRecord& e) { return e.metrics.tracking.roll_rmse_rad; }},
    {"pitch_rmse_rad", [](const EpisodeRecord& e) { return e.metrics.tracking.pitch_rmse_rad; }},
    {"mpc_median_s", [](const EpisodeRecord& e) { return e.metrics.mpc.median_s; }},
    {"mpc_p99_s", [](const EpisodeRecord& e) { return e.metrics.mpc.p99_s; }},
    {"wbc_median_s", [](const EpisodeRecord& e) { return e.metrics.wbc.median_s; }},
    {"wbc_p99_s", [](const EpisodeRecord& e) { return e.metrics.wbc.p99_s; }},
    {"real_time_factor", [](const EpisodeRecord& e) { return e.real_time_factor; }},
}};

constexpr std::array<NumberOf<Cell>, 8> kCellNumbers = {{
    {"metres", [](const Cell& c) { return c.falls.exposure; }},
    {"falls_per_m", [](const Cell& c) { return c.falls.rate; }},
    {"falls_per_m_low", [](const Cell& c) { return c.falls.interval.low; }},
    {"falls_per_m_high", [](const Cell& c) { return c.falls.interval.high; }},
    {"cot_mech_abs", [](const Cell& c) { return c.cot_mech_abs; }},
    {"cot_mech_pos", [](const Cell& c) { return c.cot_mech_pos; }},
    {"cot_electrical", [](const Cell& c) { return c.cot_electrical; }},
    {"cot_battery", [](const Cell& c) { return c.cot_battery; }},
}};

using NamedNumbers = std::vector<std::pair<const char*, std::optional<double>>>;

/// None where it was not measured.
std::optional<double> IfMeasured(bool any, double value) {
  return any && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

NamedNumbers EstimationNumbers(const EstimationMetrics& m) {
  const DriftSummary d = SummariseDrift(m);
  const bool walked = m.present && d.segments > 0, rows = m.present && m.rows > 0;
  const bool short_way = m.present && m.rpe_1m.stretches > 0;
  const bool long_way = m.present && m.rpe_10m.stretches > 0;
  const ContactQuality& counted = m.contact.of(ContactWord::kCounted);
  const bool heard = m.contact.HasDetection();
  return {{"drift_horizontal_pct", IfMeasured(walked, d.horizontal_pct)},
          {"drift_vertical_pct", IfMeasured(walked, d.vertical_pct)},
          {"drift_yaw_deg_per_m", IfMeasured(walked, d.yaw_deg_per_m)},
          {"rpe_1m_horizontal_m", IfMeasured(short_way, m.rpe_1m.horizontal_rms_m)},
          {"rpe_1m_vertical_m", IfMeasured(short_way, m.rpe_1m.vertical_rms_m)},
          {"rpe_10m_horizontal_m", IfMeasured(long_way, m.rpe_10m.horizontal_rms_m)},
          {"rpe_10m_vertical_m", IfMeasured(long_way, m.rpe_10m.vertical_rms_m)},
          {"est_velocity_rmse_mps", IfMeasured(rows, m.velocity_rmse_mps)},
          {"est_roll_rmse_rad", IfMeasured(rows, m.roll_rmse_rad)},
          {"est_pitch_rmse_rad", IfMeasured(rows, m.pitch_rmse_rad)},
          {"nees_ratio", IfMeasured(m.nees_rows > 0, m.nees_ratio)},
          {"nis_ratio", IfMeasured(m.nis_dof > 0, m.nis_ratio)},
          {"contact_accuracy", IfMeasured(heard, counted.Accuracy())},
          {"touchdown_delay_median_s", IfMeasured(heard && counted.touchdown.delays.count() > 0,
                                                  counted.touchdown.delays.Quantile(0.5))},
          {"sensor_auc", IfMeasured(heard, m.contact.sensor.Area())},
          {"observer_auc", IfMeasured(heard, m.contact.observer.Area())}};
}

/// All of the intervals of mass of an episode or of several.
NamedNumbers ModelNumbers(const std::vector<ModelMetrics>& models) {
  std::vector<ModelInterval> intervals;
  for (const ModelMetrics& m : models)
    intervals.insert(intervals.end(), m.intervals.begin(), m.intervals.end());
  const ModelSummary s = SummariseModel(intervals);
  const bool judged = s.judged > 0, settled = s.settled > 0;
  return {{"model_bias_median_kg", IfMeasured(settled, s.median_bias_kg)},
          {"model_bias_p95_kg", IfMeasured(settled, s.p95_bias_kg)},
          {"model_rmse_median_kg", IfMeasured(settled, s.median_rmse_kg)},
          {"model_settling_median_s", IfMeasured(judged, s.median_settling_s)},
          {"model_com_x_rmse_median_m", IfMeasured(settled, s.median_com_x_rmse_m)},
          {"model_com_y_rmse_median_m", IfMeasured(settled, s.median_com_y_rmse_m)},
          {"model_settled_share",
           IfMeasured(judged, static_cast<double>(s.settled) / static_cast<double>(s.judged))},
          {"model_used_bias_median_kg", IfMeasured(s.used > 0, s.median_used_bias_kg)}};
}

/// A CSV field.
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string CsvHeader(const std::vector<Axis>& axes) {
  std::string header = "id,arm";
  for (const Axis& axis : axes) header += "," + Quoted(axis.key);
  header += ",seed,end";
  for (const NumberOf<EpisodeRecord>& number : kEpisodeNumbers)
    header += fmt::format(",{}", number.key);
  for (const auto& [name, value] : EstimationNumbers({})) header += fmt::format(",{}", name);
  for (const auto& [name, value] : ModelNumbers({})) header += fmt::format(",{}", name);
  return header + "\n";
}

std::string CsvLine(const EpisodeRecord& e) {
  std::string line = Quoted(e.id) + "," + Quoted(e.arm);
  for (const std::string& value : e.point) line += "," + Quoted(value);
  line += fmt::format(",{},{}", e.seed, e.end);
  for (const NumberOf<EpisodeRecord>& number : kEpisodeNumbers)
    line += fmt::format(",{}", number.value(e));
  const auto append = [&](const NamedNumbers& numbers) {
    for (const auto& [name, value] : numbers) line += value ? fmt::format(",{}", *value) : ",";
  };
  append(EstimationNumbers(e.metrics.estimation));
  append(ModelNumbers({e.metrics.model}));
  return line + "\n";
}

json ToJson(const NamedNumbers& numbers) {
  json object = json::object();
  for (const auto& [name, value] : numbers) object[name] = value ? json(*value) : nullptr;
  return object;
}

json ToJson(const Cell& c) {
  json object = {{"arm", c.arm},
                 {"point", c.point},
                 {"falls", c.falls.events},
                 {"stuck", c.stuck},
                 {"estimation", ToJson(EstimationNumbers(c.estimation))},
                 {"model", ToJson(ModelNumbers(c.models))}};
  for (const NumberOf<Cell>& number : kCellNumbers) object[number.key] = number.value(c);
  return object;
}

json ToJson(const Comparison& c) {
  return {{"a", c.a},
          {"b", c.b},
          {"point", c.point},
          {"ratio", c.ratio.ratio},
          {"low", c.ratio.interval.low},
          {"high", c.ratio.interval.high},
          {"p_value", c.ratio.p_value},
          {"dispersion", c.dispersion.index},
          {"verdict", c.verdict}};
}

}  // namespace

void WriteMetricFiles(const ReportInput& input, const std::filesystem::path& folder) {
  std::string csv = CsvHeader(input.results.axes);
  for (const EpisodeRecord& e : input.results.episodes) csv += CsvLine(e);
  core::WriteText(folder / "metrics.csv", csv);

  json all = {
      {"name", input.results.name}, {"cells", json::array()}, {"comparisons", json::array()}};
  for (const Cell& c : input.cells) all["cells"].push_back(ToJson(c));
  for (const Comparison& c : input.comparisons) all["comparisons"].push_back(ToJson(c));
  core::WriteText(folder / "metrics.json", JsonText(all));
}

}  // namespace scoria::analysis
