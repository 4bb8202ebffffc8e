// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/paired_difference.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace scoria::analysis {
namespace {

// Extra hours of sleep with two drugs. Source: Student, Biometrika 6, 1908; t = -4.0621, p =
// 0.00283.
TEST(PairedDifference, IsThatOfStudentsSleep) {
  const std::vector<double> a = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
  const std::vector<double> b = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
  const PairedDifference d = EstimateDifference(a, b, 1);
  EXPECT_NEAR(d.mean_a, 0.75, 1e-12);
  EXPECT_NEAR(d.mean_b, 2.33, 1e-12);
  EXPECT_NEAR(d.difference.mean, -1.58, 1e-12);
  EXPECT_NEAR(d.difference.interval.low, -2.4598858, 1e-6);
  EXPECT_NEAR(d.difference.interval.high, -0.7001142, 1e-6);
  EXPECT_NEAR(d.p_value, 0.002833, 1e-6);
  ASSERT_TRUE(d.effect_size && d.correlation && d.bootstrap);
  EXPECT_NEAR(*d.effect_size, -1.58 / 1.2299, 1e-4);
  EXPECT_NEAR(*d.correlation, 0.7951702, 1e-6);
  EXPECT_LT(d.bootstrap->low, -1.58);
  EXPECT_LT(d.bootstrap->high, 0.0);
  EXPECT_EQ(EstimateDifference(a, b, 1).bootstrap->low, d.bootstrap->low) << "repeats";
}

TEST(PairedDifference, SaysNothingOfTooLittle) {
  const std::vector<double> one = {1.0}, four = {1.0, 2.0, 3.0, 4.0}, alike(4, 2.0);
  const PairedDifference single = EstimateDifference(one, one, 1);
  EXPECT_EQ(single.p_value, 1.0);
  EXPECT_FALSE(single.effect_size || single.correlation || single.bootstrap);
  EXPECT_FALSE(EstimateDifference(four, alike, 1).bootstrap) << "of four pairs";
  EXPECT_FALSE(EstimateDifference(four, alike, 1).correlation) << "with what does not vary";
  EXPECT_EQ(EstimateDifference(four, four, 1).p_value, 1.0);
  EXPECT_EQ(EstimateDifference(std::vector<double>{2.0, 3.0, 4.0, 5.0}, four, 1).p_value, 0.0)
      << "always one more";
}

// 1000 campaigns of eight seeds whose differences are exponential with mean 1, far from normal.
// Student's interval and the bootstrap's both miss somewhat more often than one in twenty; the
// plain percentile interval would miss one in seven.
TEST(PairedDifference, BootstrapCoversAboutAsWellAsStudent) {
  int student = 0, bootstrap = 0, normal = 0;
  for (std::uint64_t i = 0; i < 1000; ++i) {
    core::Rng rng(i, 0, core::Stream::kOperator);
    std::vector<double> skew, symmetric;
    for (int k = 0; k < 8; ++k) {
      skew.push_back(-std::log(1.0 - rng.NextUniform()));
      symmetric.push_back(rng.NextNormal());
    }
    const std::vector<double> zero(8, 0.0);
    const PairedDifference d = EstimateDifference(skew, zero, 1);
    if (d.difference.interval.Contains(1.0)) ++student;
    if (d.bootstrap->Contains(1.0)) ++bootstrap;
    if (EstimateDifference(symmetric, zero, 1).bootstrap->Contains(0.0)) ++normal;
  }
  EXPECT_GE(bootstrap, student - 20);
  EXPECT_GE(bootstrap, 880);
  EXPECT_GE(normal, 934);
}

}  // namespace
}  // namespace scoria::analysis
