// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "analysis/statistics/paired_counts.h"
#include "analysis/statistics/rate_ratio.h"

namespace scoria::analysis {

/// Rate ratio a : b without the assumption that falls are Poisson: terrains (clusters) are
/// resampled with their pairs of counts. The standard error of the log ratio over the resamples,
/// widened by √(n / (n - 1)), gives interval and p-value with Student's quantiles of n - 1 degrees
/// of freedom: percentiles of few clusters are too narrow. Half an event is added to either side,
/// so that resamples without events are finite.
/// @param terrains  >= 3 with some event, otherwise NaN with the interval [0, inf) and p = 1.
/// Source: [Cameron2008], bootstrap of clusters; small samples as [Hesterberg2015].
[[nodiscard]] RatioEstimate BootstrapRateRatio(std::span<const PairedCounts> terrains,
                                               std::uint64_t seed, int resamples = 2000,
                                               double confidence = 0.95);

/// Ratio of two rate ratios a : b, that of the first setting to that of the second, likewise.
/// Terrains are resampled with all four counts.
/// @param terrains  >= 3 with some event in each setting, otherwise as above.
[[nodiscard]] RatioEstimate BootstrapRatioOfRatios(std::span<const CountsInTwoSettings> terrains,
                                                   std::uint64_t seed, int resamples = 2000,
                                                   double confidence = 0.95);

}  // namespace scoria::analysis
