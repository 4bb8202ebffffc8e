// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/rate.h"

#include <cmath>

#include <boost/math/distributions/poisson.hpp>
#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

// The paper's headline, two falls in 267 m, has an exact interval of 37 to 1102 m per fall (peer
// survey, section 0).
TEST(Rate, GarwoodIntervalOfThePapersHeadline) {
  const RateEstimate e = EstimateRate(2, 267.0);
  EXPECT_NEAR(1.0 / e.rate, 133.5, 1e-9);
  EXPECT_NEAR(1.0 / e.interval.high, 37.0, 0.1);
  EXPECT_NEAR(1.0 / e.interval.low, 1102.0, 2.0);
}

TEST(Rate, NoEventGivesTheRuleOfThree) {
  const RateEstimate e = EstimateRate(0, 100.0);
  EXPECT_EQ(e.interval.low, 0.0);
  EXPECT_NEAR(e.interval.high, 0.03689, 1e-4);  // -ln(0.025) / 100
}

/// Limits of the mean count, without chi-squared: where the tails of the Poisson distribution are
/// 2.5 %, by bisection.
Interval LimitsByTails(long events) {
  const auto solve = [&](auto rises) {
    double low = 0.0, high = 300.0;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (rises(middle) ? high : low) = middle;
    }
    return high;
  };
  using Poisson = boost::math::poisson_distribution<double>;
  const double n = static_cast<double>(events);
  return {events == 0 ? 0.0 : solve([&](double mean) {
            return cdf(complement(Poisson(mean), n - 1.0)) > 0.025;
          }),
          solve([&](double mean) { return cdf(Poisson(mean), n) < 0.025; })};
}

// Two events: 0.2422 to 7.2247, as tabulated; 0, 1, 5, 10 and 50: Ulm, American Journal of
// Epidemiology 131, 1990.
TEST(Rate, IntervalsAreThoseOfTables) {
  const struct {
    long events;
    double low, high;
  } table[] = {{0, 0.0, 3.6889},
               {1, 0.0253, 5.5716},
               {2, 0.2422, 7.2247},
               {5, 1.6235, 11.6683},
               {10, 4.7954, 18.3904}};
  for (const auto& t : table) {
    const Interval interval = EstimateRate(t.events, 1.0).interval;
    EXPECT_NEAR(interval.low, t.low, 5e-5) << t.events;
    EXPECT_NEAR(interval.high, t.high, 5e-5) << t.events;
  }
  for (const long events : {0L, 1L, 2L, 3L, 7L, 20L, 77L, 150L}) {
    const Interval interval = EstimateRate(events, 1.0).interval, by_tails = LimitsByTails(events);
    EXPECT_NEAR(interval.low, by_tails.low, 1e-6) << events;
    EXPECT_NEAR(interval.high, by_tails.high, 1e-6) << events;
  }
}

TEST(Rate, IntervalsCoverAtLeast95PerCent) {
  double sum = 0.0;
  int means = 0;
  for (double mean = 0.5; mean <= 80.0; mean += 0.05) {
    const boost::math::poisson_distribution<double> counts(mean);
    double coverage = 0.0;
    for (long n = 0; n < 250; ++n) {
      if (EstimateRate(n, 1.0).interval.Contains(mean))
        coverage += pdf(counts, static_cast<double>(n));
    }
    EXPECT_GE(coverage, 0.95) << mean;
    sum += coverage;
    ++means;
  }
  EXPECT_LT(sum / means, 0.965) << "no wider than need be";
}

}  // namespace
}  // namespace scoria::analysis
