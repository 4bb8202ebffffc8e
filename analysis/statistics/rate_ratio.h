// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/statistics/interval.h"
#include "analysis/statistics/rate.h"

namespace scoria::analysis {

/// Ratio of the rate of `a` to the rate of `b`, exact given the total: events of a are binomial
/// with probability r x_a / (r x_a + x_b). The interval is Clopper-Pearson's; p tests "the rates
/// are equal", two-sided. Without any event the ratio is undefined: NaN with the interval [0, inf).
struct RatioEstimate {
  double ratio = 0.0;
  Interval interval;
  double p_value = 1.0;
};
/// Source: [Przyborowski1940].
[[nodiscard]] RatioEstimate EstimateRateRatio(const RateEstimate& a, const RateEstimate& b,
                                              double confidence = 0.95);

}  // namespace scoria::analysis
