// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/metric_files.h"

#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "core/config/field.h"
#include "core/files.h"

namespace scoria::analysis {
namespace {

using nlohmann::json;

/// A CSV field.
std::string Quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

std::string CsvHeader(const ReportInput& input) {
  std::string header = "id,arm";
  for (const Axis& axis : input.results.axes) header += "," + Quoted(axis.key);
  if (input.results.design) {
    for (const Factor& factor : input.results.design->factors) header += "," + Quoted(factor.key);
  }
  header += ",seed,end";
  for (const Metric& metric : input.metrics) header += fmt::format(",{}", metric.info.key);
  return header + "\n";
}

std::string CsvLine(const EpisodeRecord& e, const Metrics& metrics) {
  std::string line = Quoted(e.id) + "," + Quoted(e.arm);
  for (const std::string& value : e.point) line += "," + Quoted(value);
  line += fmt::format(",{},{}", e.seed, e.end);
  const MetricValues values = e.has_metrics ? ValuesOf(metrics, e.metrics) : MetricValues();
  for (const Metric& metric : metrics) {
    const std::optional<double> value = Find(values, metric.info.key);
    line += value ? fmt::format(",{}", *value) : ",";
  }
  return line + "\n";
}

/// The object of a cell that holds a family's numbers; null: the cell's own.
const char* ObjectOf(MetricFamily family) {
  if (family == MetricFamily::kEstimation || family == MetricFamily::kContact) return "estimation";
  return family == MetricFamily::kModel ? "model" : nullptr;
}

json ToJson(const Cell& c, const Metrics& metrics) {
  json object = {{"arm", c.arm},
                 {"point", c.point},
                 {"metres", c.falls.exposure},
                 {"falls_per_m_low", c.falls.interval.low},
                 {"falls_per_m_high", c.falls.interval.high}};
  for (const auto& [family, name] : EnumNames(MetricFamily{})) {
    const char* inner = ObjectOf(family);
    json& numbers = inner == nullptr ? object : object[inner];
    numbers.update(analysis::ToJson(MetricsOf(metrics, family), c.values));
  }
  if (!c.values.contains("distance_m"))
    object["metres"] = object["falls_per_m_low"] = object["falls_per_m_high"] = nullptr;
  return object;
}

json OrNull(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

json ToJson(const MetricDifference& d) {
  return {{"key", d.metric.key},
          {"seeds", d.pairs.difference.count},
          {"mean", d.pairs.mean_a},
          {"first_arm_mean", d.pairs.mean_b},
          {"difference", d.pairs.difference.mean},
          {"low", d.pairs.difference.interval.low},
          {"high", d.pairs.difference.interval.high},
          {"bootstrap_low", d.pairs.bootstrap ? json(d.pairs.bootstrap->low) : json(nullptr)},
          {"bootstrap_high", d.pairs.bootstrap ? json(d.pairs.bootstrap->high) : json(nullptr)},
          {"effect_size", OrNull(d.pairs.effect_size)},
          {"correlation", OrNull(d.pairs.correlation)},
          {"p_value", d.pairs.p_value},
          {"p_holm", d.holm},
          {"false_discovery_rate", d.false_discovery},
          {"better", core::EnumName(d.metric.better)}};
}

/// @param differences  of arm b against a at the same point.
json ToJson(const Comparison& c, const ArmDifferences& differences) {
  json object = {{"a", c.a},
                 {"b", c.b},
                 {"point", c.point},
                 {"ratio", c.rates.judged.ratio},
                 {"low", c.rates.judged.interval.low},
                 {"high", c.rates.judged.interval.high},
                 {"p_value", c.rates.judged.p_value},
                 {"p_holm", c.holm},
                 {"false_discovery_rate", c.false_discovery},
                 {"p_any_time", c.p_any_time},
                 {"detectable_ratio", c.detectable},
                 {"log_rank_p", c.log_rank.p_value},
                 {"exact_low", c.rates.exact.interval.low},
                 {"exact_high", c.rates.exact.interval.high},
                 {"by_terrain_low", c.rates.by_terrain.interval.low},
                 {"by_terrain_high", c.rates.by_terrain.interval.high},
                 {"over_dispersed", c.rates.over_dispersed},
                 {"dispersion", c.rates.dispersion.index},
                 {"verdict", c.verdict},
                 {"metrics", json::array()}};
  for (const MetricDifference& d : differences.metrics) object["metrics"].push_back(ToJson(d));
  return object;
}

}  // namespace

void WriteMetricFiles(const ReportInput& input, const std::filesystem::path& folder) {
  std::string csv = CsvHeader(input);
  for (const EpisodeRecord& e : input.results.episodes) csv += CsvLine(e, input.metrics);
  core::WriteText(folder / "metrics.csv", csv);

  json all = {
      {"name", input.results.name}, {"cells", json::array()}, {"comparisons", json::array()}};
  for (const Cell& c : input.cells) all["cells"].push_back(ToJson(c, input.metrics));
  for (std::size_t i = 0; i < input.comparisons.size(); ++i)
    all["comparisons"].push_back(ToJson(input.comparisons[i], input.differences[i]));
  core::WriteText(folder / "metrics.json", JsonText(all));
}

}  // namespace scoria::analysis
