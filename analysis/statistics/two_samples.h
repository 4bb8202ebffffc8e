// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {

/// The means of two sets of independent values, as one number of each of some walks.
struct TwoSamples {
  std::size_t count_a = 0, count_b = 0;
  double mean_a = 0.0, mean_b = 0.0;
  Interval difference;           // of mean b - mean a; unbounded where the scatter is not known
  std::optional<double> effect;  // the difference over the deviation within the sets, Hedges' g
  std::optional<double> p;       // two-sided, of "the means are equal"
};

/// Welch's t-test. A set of one value is taken to scatter as the other one does: the test is then
/// whether it is another value of that set. Without scatter, or with a value in each set, there is
/// no test.
/// @param a, b  not empty.   @param confidence  of the interval, in (0, 1).
/// Source: [Welch1947]; effect size: [Hedges1981].
[[nodiscard]] TwoSamples CompareSamples(std::span<const double> a, std::span<const double> b,
                                        double confidence = 0.95);

/// The same of magnitudes, which scatter in proportion to their size: the test and the effect are
/// of their logarithms, means are geometric, and the interval is that of the ratio, as a difference
/// from the first mean.
/// @param a, b  not empty, positive.
[[nodiscard]] TwoSamples CompareMagnitudes(std::span<const double> a, std::span<const double> b,
                                           double confidence = 0.95);

}  // namespace scoria::analysis
