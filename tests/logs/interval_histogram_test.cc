// SPDX-License-Identifier: BSD-3-Clause
#include "logs/interval_histogram.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace scoria::logs {
namespace {

TEST(IntervalHistogram, EqualIntervalsAreExact) {
  for (const std::int64_t interval_ns :
       {std::int64_t{0}, std::int64_t{2'000'001}, std::int64_t{-333'333'333},
        std::int64_t{1'700'000'000'123'456}}) {
    IntervalHistogram histogram;
    for (int i = 0; i < 1000; ++i) histogram.Add(interval_ns);
    EXPECT_EQ(histogram.Quantile_ns(0.5), static_cast<double>(interval_ns));
  }
}

TEST(IntervalHistogram, QuantilesAreThoseOfSortedIntervalsToABin) {
  core::Rng rng(5, 0, core::Stream::kRocks);
  IntervalHistogram histogram;
  std::vector<double> all;
  for (int i = 0; i < 5001; ++i) {
    // Of any size and sign.
    const double magnitude = std::exp(rng.NextUniform(0.0, 40.0));
    const auto interval_ns = static_cast<std::int64_t>(i % 3 == 0 ? -magnitude : magnitude);
    histogram.Add(interval_ns);
    all.push_back(static_cast<double>(interval_ns));
  }
  std::sort(all.begin(), all.end());
  for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    const double exact = all[static_cast<std::size_t>(share * 5000.0)];
    EXPECT_NEAR(histogram.Quantile_ns(share), exact, std::abs(exact) / 512.0) << share;
  }
  EXPECT_EQ(histogram.CountWithin(all.front(), all.back()), 5001u);
}

TEST(IntervalHistogram, TakesTheOutermostNumbers) {
  using Limits = std::numeric_limits<std::int64_t>;
  IntervalHistogram histogram;
  histogram.Add(Limits::min());
  histogram.Add(Limits::max());
  EXPECT_EQ(histogram.Quantile_ns(0.0), static_cast<double>(Limits::min()));
  EXPECT_EQ(histogram.Quantile_ns(1.0), static_cast<double>(Limits::max()));
}

}  // namespace
}  // namespace scoria::logs
