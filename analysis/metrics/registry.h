// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "analysis/metrics/metric.h"

namespace scoria::analysis {

/// Every metric there is, family by family: the one list of them.
[[nodiscard]] Metrics AllMetrics();

/// Those of a family, in their order.
[[nodiscard]] Metrics MetricsOf(const Metrics& metrics, MetricFamily family);

/// @returns null where there is none. The pointer is into `metrics`.
[[nodiscard]] const Metric* FindMetric(const Metrics& metrics, std::string_view key) noexcept;

/// What rows lacked of what is needed of them.
/// @param had  groups; nothing of results that do not say which, and of which none is missing.
[[nodiscard]] logs::RowGroups MissingGroups(const logs::RowGroups& needs,
                                            const std::optional<logs::RowGroups>& had);

/// What rows lacked of what a metric needs. What stood in for a group counts for the metrics that
/// take it, and for all that when the robot walked.
[[nodiscard]] logs::RowGroups MissingGroups(const MetricInfo& metric,
                                            const std::optional<logs::RowGroups>& had,
                                            const Substitutes& substitutes);

/// "the log has no truth, energy and ledger". @pre some group is missing.
[[nodiscard]] std::string DescribeMissing(const logs::RowGroups& missing);

/// The value of an episode; nothing where it was not measured, or is not finite.
[[nodiscard]] std::optional<double> ValueOf(const Metric& metric, const EpisodeMetrics& m);
[[nodiscard]] MetricValues ValuesOf(const Metrics& metrics, const EpisodeMetrics& m);

/// The values of several episodes, each pooled as its metric says.
/// @param sum  the episodes added up.
[[nodiscard]] MetricValues PoolValues(const Metrics& metrics, const EpisodeMetrics& sum,
                                      std::span<const EpisodeMetrics* const> episodes);

[[nodiscard]] std::optional<double> Find(const MetricValues& values, std::string_view key);

/// {"distance_m": 12.3, "nees_ratio": null, ...}: every metric, null where it was not measured.
[[nodiscard]] nlohmann::json ToJson(const Metrics& metrics, const MetricValues& values);

}  // namespace scoria::analysis
