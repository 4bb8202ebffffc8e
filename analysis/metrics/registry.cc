// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/registry.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

/// Of an episode, by either source of the metric.
std::optional<Measured> Measure(const Metric& metric, const EpisodeMetrics& m) {
  if (MissingGroups(metric.info, m.groups, m.substitutes).any()) return std::nullopt;
  if (m.withheld.contains(metric.info.key)) return std::nullopt;
  std::optional<Measured> found;
  if (metric.find != nullptr) {
    found = metric.find(m);
  } else if (const auto own = m.measured.find(std::string(metric.info.key));
             own != m.measured.end()) {
    found = own->second;
  }
  return found && std::isfinite(found->value) ? found : std::nullopt;
}

std::optional<double> Pool(Pooling pooling, const std::vector<Measured>& episodes) {
  if (episodes.empty()) return std::nullopt;
  double sum = 0.0, weighted = 0.0, squares = 0.0, weight = 0.0, largest = episodes.front().value;
  for (const Measured& e : episodes) {
    sum += e.value;
    weighted += e.weight * e.value;
    squares += e.weight * e.value * e.value;
    weight += e.weight;
    largest = std::max(largest, e.value);
  }
  if (pooling == Pooling::kSum) return sum;
  if (pooling == Pooling::kLargest) return largest;
  if (weight <= 0.0) return std::nullopt;
  return pooling == Pooling::kRms ? std::sqrt(squares / weight) : weighted / weight;
}

std::optional<double> PoolMetric(const Metric& metric, const EpisodeMetrics& sum,
                                 std::span<const EpisodeMetrics* const> episodes) {
  if (metric.info.pooling == Pooling::kAccumulated) return ValueOf(metric, sum);
  std::vector<Measured> measured;
  for (const EpisodeMetrics* e : episodes) {
    if (const auto found = Measure(metric, *e)) measured.push_back(*found);
  }
  return Pool(metric.info.pooling, measured);
}

}  // namespace

Metrics AllMetrics() {
  Metrics all;
  for (const auto family :
       {SafetyMetrics, TransportMetrics, TrackingMetrics, EstimationFamilyMetrics,
        ContactFamilyMetrics, ModelFamilyMetrics, EnergyMetrics, EffortMetrics, TimingMetrics,
        GaitMetrics, FieldMetrics}) {
    for (const Metric& metric : family()) all.push_back(metric);
  }
  all.push_back(FallbackShareMetric());
  return all;
}

Metrics MetricsOf(const Metrics& metrics, MetricFamily family) {
  Metrics some;
  std::copy_if(metrics.begin(), metrics.end(), std::back_inserter(some),
               [&](const Metric& m) { return m.info.family == family; });
  return some;
}

const Metric* FindMetric(const Metrics& metrics, std::string_view key) noexcept {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const Metric& m) { return m.info.key == key; });
  return found == metrics.end() ? nullptr : &*found;
}

logs::RowGroups MissingGroups(const logs::RowGroups& needs,
                              const std::optional<logs::RowGroups>& had) {
  return had ? needs & ~*had : logs::RowGroups();
}

logs::RowGroups MissingGroups(const MetricInfo& metric, const std::optional<logs::RowGroups>& had,
                              const Substitutes& substitutes) {
  logs::RowGroups missing = MissingGroups(metric.needs, had);
  for (const auto& [group, source] : substitutes) {
    const bool counts = metric.takes_substitutes || group == logs::RowGroup::kEpisode;
    if (counts) missing.reset(static_cast<std::size_t>(group));
  }
  return missing;
}

std::string DescribeMissing(const logs::RowGroups& missing) {
  std::vector<std::string_view> names;
  for (const auto& [group, name] : EnumNames(logs::RowGroup{})) {
    if (missing[static_cast<std::size_t>(group)]) names.push_back(name);
  }
  std::string text = "the log has no ";
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " and " : ", ";
    text += names[i];
  }
  return text;
}

std::optional<double> ValueOf(const Metric& metric, const EpisodeMetrics& m) {
  const std::optional<Measured> found = Measure(metric, m);
  return found ? std::optional(found->value) : std::nullopt;
}

MetricValues ValuesOf(const Metrics& metrics, const EpisodeMetrics& m) {
  MetricValues values;
  for (const Metric& metric : metrics) {
    if (const auto value = ValueOf(metric, m)) values[std::string(metric.info.key)] = *value;
  }
  return values;
}

MetricValues PoolValues(const Metrics& metrics, const EpisodeMetrics& sum,
                        std::span<const EpisodeMetrics* const> episodes) {
  MetricValues values;
  for (const Metric& metric : metrics) {
    if (const auto value = PoolMetric(metric, sum, episodes))
      values[std::string(metric.info.key)] = *value;
  }
  return values;
}

std::optional<double> Find(const MetricValues& values, std::string_view key) {
  const auto found = values.find(key);
  return found == values.end() ? std::nullopt : std::optional(found->second);
}

nlohmann::json ToJson(const Metrics& metrics, const MetricValues& values) {
  nlohmann::json object = nlohmann::json::object();
  for (const Metric& metric : metrics) {
    const std::optional<double> value = Find(values, metric.info.key);
    object[std::string(metric.info.key)] = value ? nlohmann::json(*value) : nullptr;
  }
  return object;
}

}  // namespace scoria::analysis
