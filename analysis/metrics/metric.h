// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "logs/row.h"

namespace scoria::analysis {

struct EpisodeMetrics;

/// Metrics that stand in one table.
enum class MetricFamily {
  kSafety,
  kTransport,
  kTracking,
  kEstimation,
  kContact,
  kModel,
  kEnergy,
  kTiming,
  kGait,
};
inline constexpr std::size_t kNumMetricFamilies = 9;
constexpr std::array<std::pair<MetricFamily, std::string_view>, kNumMetricFamilies> EnumNames(
    MetricFamily) {
  return {{{MetricFamily::kSafety, "safety"},
           {MetricFamily::kTransport, "transport"},
           {MetricFamily::kTracking, "tracking"},
           {MetricFamily::kEstimation, "estimation"},
           {MetricFamily::kContact, "contact"},
           {MetricFamily::kModel, "model"},
           {MetricFamily::kEnergy, "energy"},
           {MetricFamily::kTiming, "timing"},
           {MetricFamily::kGait, "gait"}}};
}

/// Which direction is better.
enum class Better { kLower, kHigher, kNeither };
constexpr std::array<std::pair<Better, std::string_view>, 3> EnumNames(Better) {
  return {{{Better::kLower, "lower"}, {Better::kHigher, "higher"}, {Better::kNeither, "neither"}}};
}

/// How the values of several episodes become one.
enum class Pooling {
  kSum,
  kMean,  // weighted
  kRms,   // root of the weighted mean of squares
  kLargest,
  kAccumulated,  // the value of what the episodes' accumulators hold, added up
};

/// Everything said of a metric: the one place for it. All texts live as long as the program.
struct MetricInfo {
  std::string_view key = "";  // in result.json, metrics.json, metrics.csv
  MetricFamily family = MetricFamily::kTransport;
  std::string_view symbol = "";
  std::string_view unit = "";        // of the value; empty: dimensionless
  std::string_view title = "";       // in tables and texts
  std::string_view shown_unit = "";  // there; empty: the unit
  double scale = 1.0;                // from unit to shown_unit
  int digits = 2;                    // shown after the point
  logs::RowGroups needs = {};        // of a log's rows
  Better better = Better::kNeither;
  Pooling pooling = Pooling::kMean;
  /// What weighs the episodes of a mean, as "episodes" or "steady time"; of accumulated values all
  /// words there are, as "median over segments".
  std::string_view pooled_over = "episodes";
  std::string_view definition = "";  // one sentence
  /// What it needs of the truth may be another source's in the log of a robot, which is then named
  /// (EpisodeMetrics::substitutes).
  bool takes_substitutes = false;
};

/// A value of an episode, and its weight in a mean over episodes.
struct Measured {
  double value = 0.0, weight = 1.0;
  bool operator==(const Measured&) const = default;
};

/// Measures one number from the rows of an episode.
class RowMetric {
 public:
  virtual ~RowMetric() = default;
  /// @pre the row has every group that the metric needs.
  virtual void AddRow(const logs::Row& row) = 0;
  /// Nothing where it was not measured.
  [[nodiscard]] virtual std::optional<Measured> Value() const = 0;
};

/// A metric of the registry. It has one of two sources, and the other is null.
struct Metric {
  MetricInfo info;
  /// From what MetricsAccumulator found in an episode, or in several added up; nothing where it was
  /// not measured.
  std::optional<Measured> (*find)(const EpisodeMetrics& metrics) = nullptr;
  /// From the rows, by an accumulator of its own.
  std::unique_ptr<RowMetric> (*make)() = nullptr;
};
using Metrics = std::vector<Metric>;

/// What stood in for groups that a log lacks, in words: {kTruth, "the robot's own estimate"}.
using Substitutes = std::map<logs::RowGroup, std::string>;

/// By key, those that were measured.
using MetricValues = std::map<std::string, double, std::less<>>;

/// The groups as a set, for MetricInfo::needs.
[[nodiscard]] inline logs::RowGroups Groups(std::initializer_list<logs::RowGroup> groups) {
  logs::RowGroups set;
  for (const logs::RowGroup group : groups) set.set(static_cast<std::size_t>(group));
  return set;
}

/// The `make` of a metric that `Accumulator` measures.
template <class Accumulator>
[[nodiscard]] std::unique_ptr<RowMetric> MakeRowMetric() {
  return std::make_unique<Accumulator>();
}

}  // namespace scoria::analysis
