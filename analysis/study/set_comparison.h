// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/metrics/registry.h"
#include "analysis/statistics/two_samples.h"

namespace scoria::analysis {

/// A metric in two sets of walks. A walk, a log or an episode, is one value, whatever its length:
/// rows of one log are not independent.
struct SetDifference {
  MetricInfo metric;
  TwoSamples samples;
  std::optional<double> p_adjusted;  // over all metrics that are tested, by Holm
};

/// All metrics of two sets.
struct SetComparison {
  std::vector<SetDifference> metrics;
  /// Metrics that both sets have, but from other sources: the truth in some walks, and what stands
  /// in for it in others.
  std::vector<MetricInfo> other_sources;
};

/// The metrics that both sets have. Sums over a walk, which grow with its length, and wall-clock
/// times are not compared.
/// @param a, b  not empty.
[[nodiscard]] SetComparison CompareSets(std::span<const EpisodeMetrics> a,
                                        std::span<const EpisodeMetrics> b, const Metrics& metrics);

/// True if the test says so, adjusted for all the metrics that were looked at.
[[nodiscard]] bool IsDifferent(const SetDifference& d, double alpha);

/// "stride time is longer in the second: 0.52 s, not 0.48 s (3.1 deviations, p = 0.004)", or that
/// there is no evidence, or why there is no test.
[[nodiscard]] std::string DescribeDifference(const SetDifference& d, double alpha);

}  // namespace scoria::analysis
