// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/rate_ratio.h"

#include <algorithm>
#include <limits>

#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/binomial.hpp>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {

RatioEstimate EstimateRateRatio(const RateEstimate& a, const RateEstimate& b, double confidence) {
  RatioEstimate r;
  const long total = a.events + b.events;
  if (total == 0 || a.exposure <= 0.0 || b.exposure <= 0.0) {
    r.ratio = std::numeric_limits<double>::quiet_NaN();
    r.interval = {0.0, kInfinity};
    return r;
  }
  const double x = static_cast<double>(a.events), n = static_cast<double>(total);
  const auto odds_to_ratio = [&](double p) {
    return p >= 1.0 ? kInfinity : p / (1.0 - p) * b.exposure / a.exposure;
  };
  r.ratio = b.events == 0 ? kInfinity : a.rate / b.rate;
  const double alpha = 1.0 - confidence;
  using Beta = boost::math::beta_distribution<double>;
  const double low = a.events == 0 ? 0.0 : quantile(Beta(x, n - x + 1.0), alpha / 2.0);
  const double high = b.events == 0 ? 1.0 : quantile(Beta(x + 1.0, n - x), 1.0 - alpha / 2.0);
  r.interval = {odds_to_ratio(low), odds_to_ratio(high)};
  const boost::math::binomial_distribution<double> null(n, a.exposure / (a.exposure + b.exposure));
  const double below = cdf(null, x), above = a.events == 0 ? 1.0 : cdf(complement(null, x - 1.0));
  r.p_value = std::min(1.0, 2.0 * std::min(below, above));
  return r;
}

}  // namespace scoria::analysis
