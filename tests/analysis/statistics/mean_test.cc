// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/mean.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

TEST(Mean, HasStudentsInterval) {
  const MeanEstimate e = EstimateMean(std::vector<double>{1.0, 2.0, 3.0});
  EXPECT_NEAR(e.mean, 2.0, 1e-12);
  EXPECT_NEAR(e.interval.low, 2.0 - 4.302653 / std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(e.interval.high, 2.0 + 4.302653 / std::sqrt(3.0), 1e-5);
  EXPECT_TRUE(std::isinf(EstimateMean(std::vector<double>{1.0}).interval.high));
}

}  // namespace
}  // namespace scoria::analysis
