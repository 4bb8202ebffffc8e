// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/statistics/interval.h"

namespace scoria::analysis {

/// A Poisson rate from `events` in `exposure`, with the exact (Garwood) interval.
struct RateEstimate {
  long events = 0;
  double exposure = 0.0;
  double rate = 0.0;  // events per unit of exposure
  Interval interval;  // of the rate
};
/// Without exposure the rate is NaN, with the interval [0, inf).
/// @param confidence in (0, 1). Source: [Garwood1936].
[[nodiscard]] RateEstimate EstimateRate(long events, double exposure, double confidence = 0.95);

}  // namespace scoria::analysis
