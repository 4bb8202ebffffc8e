// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/distribution.h"

#include <limits>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

TEST(Distribution, QuantilesAreRightWithinTwoPercent) {
  Distribution d;
  for (int i = 1; i <= 1000; ++i) d.Add(0.05 * i);  // even up to 50
  EXPECT_EQ(d.count(), 1000u);
  for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95, 1.0})
    EXPECT_NEAR(d.Quantile(share), 50.0 * share, 0.02 * 50.0 * share) << share;
}

TEST(Distribution, TakesWhatLiesOutsideItsBins) {
  Distribution d;
  d.Add(0.0);
  d.Add(1e-9);
  d.Add(1e12);
  d.Add(std::numeric_limits<double>::quiet_NaN());
  d.Add(std::numeric_limits<double>::infinity());
  EXPECT_EQ(d.count(), 3u);
  EXPECT_EQ(d.Quantile(0.5), 0.0);
  EXPECT_NEAR(d.Quantile(1.0), 1e4, 500.0) << "the end of its range";
}

}  // namespace
}  // namespace scoria::analysis
