// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/two_samples.h"

#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace scoria::analysis {
namespace {

const std::vector<double> kA = {0.51, 0.53, 0.49, 0.55, 0.50};
const std::vector<double> kB = {0.56, 0.58, 0.52, 0.61, 0.57, 0.60, 0.55};

// Expected values by numerical integration of Student's density, apart from this code.
TEST(TwoSamples, IsWelchsTest) {
  const TwoSamples s = CompareSamples(kA, kB);
  EXPECT_EQ(s.count_a, 5u);
  EXPECT_EQ(s.count_b, 7u);
  ASSERT_TRUE(s.p && s.effect);
  EXPECT_NEAR(*s.p, 0.0067165308, 1e-6);
  EXPECT_NEAR(*s.effect, 1.7712059513, 1e-6);
  EXPECT_GT(s.difference.low, 0.0);
  EXPECT_NEAR(0.5 * (s.difference.low + s.difference.high), s.mean_b - s.mean_a, 1e-12);
}

TEST(TwoSamples, AskOfASingleWalkWhetherItIsOneOfTheOthers) {
  const std::vector<double> one = {0.70};
  const TwoSamples s = CompareSamples(one, kB);
  ASSERT_TRUE(s.p);
  EXPECT_NEAR(*s.p, 0.0072797447, 1e-6);
  const TwoSamples turned = CompareSamples(kB, one);
  EXPECT_NEAR(*turned.p, *s.p, 1e-12);
  EXPECT_NEAR(*turned.effect, -*s.effect, 1e-12);
}

TEST(TwoSamples, MagnitudesAreComparedByTheirRatio) {
  const std::vector<double> a = {10.0, 20.0, 40.0}, b = {40.0, 80.0, 160.0};
  const TwoSamples s = CompareMagnitudes(a, b);
  EXPECT_NEAR(s.mean_a, 20.0, 1e-12);
  EXPECT_NEAR(s.mean_b, 80.0, 1e-12);
  // The logarithms differ by ln 4, with the same scatter ln 2: t = 2 / sqrt(2 / 3).
  EXPECT_NEAR(*s.effect, (1.0 - 3.0 / 15.0) * 2.0, 1e-12);
  EXPECT_NEAR(*s.p, 0.0705, 1e-4);
  EXPECT_NEAR((s.mean_a + s.difference.low) * (s.mean_a + s.difference.high), 80.0 * 80.0, 1e-6);
}

TEST(TwoSamples, WithoutScatterThereIsNoTest) {
  EXPECT_FALSE(CompareSamples(std::vector{1.0}, std::vector{2.0}).p);
  EXPECT_FALSE(CompareSamples(std::vector{1.0, 1.0}, std::vector{2.0, 2.0}).p);
}

// Also with one value on a side, and with scatters that differ.
TEST(TwoSamples, RejectAsOftenAsTheySay) {
  core::Rng rng(5, 0, core::Stream::kBootstrap);
  for (const auto& [n_a, n_b, scale] :
       {std::tuple{1, 8, 1.0}, std::tuple{8, 8, 3.0}, std::tuple{4, 12, 1.0}}) {
    SCOPED_TRACE(n_a);
    int rejected = 0;
    constexpr int kRuns = 4000;
    for (int run = 0; run < kRuns; ++run) {
      std::vector<double> a, b;
      for (int i = 0; i < n_a; ++i) a.push_back(2.0 + rng.NextNormal());
      for (int i = 0; i < n_b; ++i) b.push_back(2.0 + scale * rng.NextNormal());
      rejected += *CompareSamples(a, b).p <= 0.05;
    }
    EXPECT_NEAR(static_cast<double>(rejected) / kRuns, 0.05, 0.012);
  }
}

}  // namespace
}  // namespace scoria::analysis
