// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "analysis/statistics/mean.h"

namespace scoria::analysis {

/// Differences a - b of pairs of the same seed.
struct PairedDifference {
  double mean_a = 0.0, mean_b = 0.0;
  MeanEstimate difference;  // with Student's interval
  /// Of the mean, by resampling pairs: from five pairs on.
  std::optional<Interval> bootstrap;
  /// Mean over standard deviation of the differences (Cohen's d of pairs); nothing where they do
  /// not vary.
  std::optional<double> effect_size;
  /// Between a and b: how much the pairing gained. The variance of the difference is
  /// (1 - correlation) times that of unpaired seeds, if both vary alike.
  std::optional<double> correlation;
  double p_value = 1.0;  // of "no difference", Student's, two-sided; 1 for fewer than two pairs
};

/// @param a, b  of equal length, in the order of the pairs.
/// Percentiles of the bootstrap are those whose coverage equals Student's for normal values.
/// Source: [Cohen1988]; [Hesterberg2015], expanded percentile interval.
[[nodiscard]] PairedDifference EstimateDifference(std::span<const double> a,
                                                  std::span<const double> b, std::uint64_t seed,
                                                  double confidence = 0.95);

}  // namespace scoria::analysis
