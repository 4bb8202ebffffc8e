// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/ratio_of_ratios.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/analysis/statistics/made_up_falls.h"

namespace scoria::analysis {
namespace {

TEST(RatioOfRatios, AgreesWithFishersTestByHand) {
  // The tea tasting: margins of four each, three right of four. P(X >= 3) = 17 / 70.
  const std::vector<CountsInTwoSettings> tea = {{{3, 1, 10, 10}, {1, 3, 10, 10}}};
  const RatioEstimate r = CompareRatios(tea).exact;
  EXPECT_NEAR(r.ratio, 9.0, 1e-12);
  EXPECT_NEAR(r.p_value, 2.0 * 17.0 / 70.0, 1e-12);
  // Roots of (16 x³ + x⁴) / S = 1/40 and of x⁴ / S = 39/40, S = 1 + 16 x + 36 x² + 16 x³ + x⁴.
  EXPECT_NEAR(r.interval.low, 0.21173560, 1e-7);
  EXPECT_NEAR(r.interval.high, 626.243531, 1e-5);
}

TEST(RatioOfRatios, ExposuresScaleIt) {
  const std::vector<CountsInTwoSettings> equal = {{{6, 4, 10, 10}, {5, 8, 10, 10}}},
                                         twice = {{{6, 4, 20, 10}, {5, 8, 10, 10}}};
  const RatioEstimate a = CompareRatios(equal).exact, b = CompareRatios(twice).exact;
  EXPECT_NEAR(b.ratio, 0.5 * a.ratio, 1e-12);
  EXPECT_NEAR(b.interval.low, 0.5 * a.interval.low, 1e-9);
  EXPECT_NEAR(b.interval.high, 0.5 * a.interval.high, 1e-9);
}

TEST(RatioOfRatios, ChangingTheSettingsInvertsIt) {
  const std::vector<CountsInTwoSettings> counts = {{{9, 2, 50, 50}, {3, 5, 50, 40}}},
                                         swapped = {{counts[0].second, counts[0].first}};
  const RatioEstimate a = CompareRatios(counts).exact, b = CompareRatios(swapped).exact;
  EXPECT_NEAR(a.ratio * b.ratio, 1.0, 1e-12);
  EXPECT_NEAR(a.interval.low * b.interval.high, 1.0, 1e-9);
  EXPECT_NEAR(a.p_value, b.p_value, 1e-9);
}

TEST(RatioOfRatios, WithoutEventsInASettingNothingIsKnown) {
  const std::vector<CountsInTwoSettings> counts(8, {{2, 1, 50, 50}, {0, 0, 50, 50}});
  const RatioOfRatios r = CompareRatios(counts);
  EXPECT_TRUE(std::isnan(r.judged.ratio));
  EXPECT_EQ(r.judged.interval.low, 0.0);
  EXPECT_TRUE(std::isinf(r.judged.interval.high));
  EXPECT_EQ(r.judged.p_value, 1.0);
  EXPECT_TRUE(std::isnan(CompareRatios({}).judged.ratio));
}

/// Campaigns of ten terrains whose interval leaves out the true ratio of ratios, and 1.
struct Misses {
  int truth = 0, one = 0;
};
Misses CountMisses(const test::FallModel& first, const test::FallModel& second, int campaigns) {
  Misses misses;
  for (int i = 0; i < campaigns; ++i) {
    const auto seed = static_cast<std::uint64_t>(2 * i);
    const auto one = test::MakeFalls(first, 10, seed),
               other = test::MakeFalls(second, 10, seed + 1);
    std::vector<CountsInTwoSettings> terrains;
    for (std::size_t k = 0; k < one.size(); ++k) terrains.push_back({one[k], other[k]});
    const Interval interval = CompareRatios(terrains).judged.interval;
    misses.truth += interval.Contains(first.ratio / second.ratio) ? 0 : 1;
    misses.one += interval.Contains(1.0) ? 0 : 1;
  }
  return misses;
}

TEST(RatioOfRatios, IntervalsMissTheTruthInFivePerCentAtMost) {
  const int kCampaigns = 300, kLimit = 15 + 11;  // 5 %, and three standard deviations
  EXPECT_LE(CountMisses({3.0, 1.5}, {3.0, 1.5}, kCampaigns).truth, kLimit);
  EXPECT_LE(CountMisses({3.0, 2.0}, {3.0, 1.0}, kCampaigns).truth, kLimit);
  EXPECT_LE(CountMisses({3.0, 1.5, 2, 2}, {3.0, 1.5, 2, 2}, kCampaigns).truth, kLimit)
      << "terrains that treat the arms differently";
}

TEST(RatioOfRatios, SeesARatioThatTheSettingTurnsRound) {
  EXPECT_GE(CountMisses({4.0, 2.0}, {4.0, 0.5}, 100).one, 90);
}

}  // namespace
}  // namespace scoria::analysis
