// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "analysis/statistics/cluster_bootstrap.h"
#include "analysis/statistics/paired_counts.h"
#include "analysis/statistics/rate_ratio.h"

namespace scoria::analysis {

/// Rates of two arms on the same terrains: the exact ratio, which takes falls for Poisson given the
/// terrain, and the one by terrain, which does not.
struct RateComparison {
  RatioEstimate exact, by_terrain;
  Dispersion dispersion;  // of a's share of the falls, across terrains
  /// Terrains treat the arms differently: judge by the wider of both intervals.
  bool over_dispersed = false;
  RatioEstimate judged;  // ratio, interval and p-value to judge by
};

/// Whether terrains treat the arms differently is judged from six terrains on, at a level of 20 %:
/// a preliminary test must not overlook what it is there to find ([Bancroft1964]).
/// @param a, b  all events and exposures, also of terrains that one of the arms did not walk.
[[nodiscard]] RateComparison CompareRates(const RateEstimate& a, const RateEstimate& b,
                                          std::span<const PairedCounts> terrains,
                                          double confidence = 0.95);

}  // namespace scoria::analysis
