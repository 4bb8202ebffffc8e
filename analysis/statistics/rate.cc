// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/rate.h"

#include <limits>

#include <boost/math/distributions/chi_squared.hpp>

namespace scoria::analysis {

RateEstimate EstimateRate(long events, double exposure, double confidence) {
  RateEstimate e;
  e.events = events;
  e.exposure = exposure;
  if (exposure <= 0.0) {
    e.rate = std::numeric_limits<double>::quiet_NaN();
    e.interval = {0.0, std::numeric_limits<double>::infinity()};
    return e;
  }
  const double alpha = 1.0 - confidence, n = static_cast<double>(events);
  e.rate = n / exposure;
  using ChiSquared = boost::math::chi_squared_distribution<double>;
  if (events > 0) e.interval.low = 0.5 * quantile(ChiSquared(2.0 * n), alpha / 2.0) / exposure;
  e.interval.high = 0.5 * quantile(ChiSquared(2.0 * n + 2.0), 1.0 - alpha / 2.0) / exposure;
  return e;
}

}  // namespace scoria::analysis
