// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/registry.h"
#include "analysis/metrics/signal_distributions.h"
#include "analysis/statistics/two_samples.h"

namespace scoria::analysis {

/// A log or an episode, as it is compared: one value of each metric, whatever its length, because
/// rows of one log are not independent.
struct ComparedWalk {
  EpisodeMetrics metrics;
  SignalDistributions signals;  // those that were read
};

/// A metric in two sets of walks.
struct SetDifference {
  MetricInfo metric;
  TwoSamples samples;
  std::optional<double> p_adjusted;  // over all that is tested, by Holm
};

/// A quantile of a signal in two sets of walks: of each walk, one value.
struct QuantileDifference {
  double share = 0.0;  // of the walk's values that are smaller
  TwoSamples samples;
};

/// At which shares distributions are compared.
inline constexpr std::array<double, 5> kComparedShares = {0.05, 0.25, 0.5, 0.75, 0.95};

/// The distribution of a signal in two sets of walks.
struct SignalDifference {
  Signal signal = Signal::kStride;
  MetricInfo info;
  std::vector<QuantileDifference> quantiles;  // at kComparedShares
  std::optional<double> p;           // the least of the quantiles', times how many are tested
  std::optional<double> p_adjusted;  // over all that is tested, by Holm

  /// The quantile that speaks most for a difference; null without a test.
  [[nodiscard]] const QuantileDifference* Strongest() const noexcept;
};

/// All metrics and signals of two sets.
struct SetComparison {
  std::vector<SetDifference> metrics;
  std::vector<SignalDifference> signals;
  /// What both sets have, but from other sources: the truth in some walks, and what stands in for
  /// it in others.
  std::vector<MetricInfo> other_sources;
};

/// The metrics and signals that both sets have. Sums over a walk, which grow with its length,
/// wall-clock times and commands are not compared; mean velocities are less their commands.
/// Signals, and metrics of which less is better, are compared as magnitudes (CompareMagnitudes)
/// unless one is zero.
/// @param a, b  not empty.
[[nodiscard]] SetComparison CompareSets(std::span<const ComparedWalk> a,
                                        std::span<const ComparedWalk> b, const Metrics& metrics);

/// True if the test says so, adjusted for all that was looked at.
[[nodiscard]] bool IsDifferent(const std::optional<double>& p_adjusted, double alpha) noexcept;

/// "stride time is longer in the second: 0.52 s, not 0.48 s (3.1 deviations, p = 0.004)", or that
/// there is no evidence, or why there is no test.
[[nodiscard]] std::string DescribeDifference(const SetDifference& d, double alpha);

/// Likewise, by the quantile that differs most.
[[nodiscard]] std::string DescribeDifference(const SignalDifference& d, double alpha);

}  // namespace scoria::analysis
