// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "analysis/statistics/sequential_ratio_test.h"
#include "tests/analysis/statistics/made_up_falls.h"

namespace scoria::analysis {
namespace {

int CountRatioRejections(const test::FallModel& model, std::uint64_t first_seed,
                         Alternative alternative, double null_ratio) {
  int rejections = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    SequentialRatioTest test(alternative, null_ratio);
    for (const PairedCounts& terrain : test::MakeFalls(model, 100, first_seed + i))
      test.Add(terrain);
    if (test.evidence().Rejects(0.05)) ++rejections;
  }
  return rejections;
}

TEST(SequentialRatioTest, SeldomRejectsItsNull) {
  const test::FallModel poisson{.falls = 2.0}, hard_and_easy{.falls = 2.0, .terrain_shape = 1};
  EXPECT_LE(CountRatioRejections(poisson, 1, Alternative::kTwoSided, 1.0), 66);
  EXPECT_LE(CountRatioRejections(hard_and_easy, 3000, Alternative::kTwoSided, 1.0), 66);
  const test::FallModel half{.falls = 2.0, .ratio = 0.5};
  EXPECT_LE(CountRatioRejections(half, 6000, Alternative::kGreater, 0.5), 66);
  EXPECT_EQ(CountRatioRejections(half, 6000, Alternative::kGreater, 1.0), 0) << "below the null";
  EXPECT_GT(CountRatioRejections(half, 6000, Alternative::kLess, 1.0), 990);
}

TEST(SequentialRatioTest, IsTheLikelihoodRatioByHand) {
  SequentialRatioTest test(Alternative::kGreater);
  test.Add({6, 1, 50.0, 100.0});
  double mean = 0.0;
  for (const double ratio : {1.25, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0}) {
    const double share = ratio / (ratio + 2.0);
    mean += std::pow(3.0 * share, 6) * 1.5 * (1.0 - share) / 7.0;
  }
  EXPECT_NEAR(test.evidence().log_e(), std::log(mean), 1e-12);
}

}  // namespace
}  // namespace scoria::analysis
