// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/rate_comparison.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/analysis/statistics/made_up_falls.h"

namespace scoria::analysis {
namespace {

TEST(Ratio, AgreesWithTheBinomialTestByHand) {
  // 1 against 9 events at equal exposure: two-sided p = 2 (C(10,0) + C(10,1)) / 2^10 = 22 / 1024.
  const RatioEstimate r = EstimateRateRatio(EstimateRate(1, 50.0), EstimateRate(9, 50.0));
  EXPECT_NEAR(r.ratio, 1.0 / 9.0, 1e-12);
  EXPECT_NEAR(r.p_value, 22.0 / 1024.0, 1e-12);
  // Clopper-Pearson for 1 of 10: 0.002529 to 0.445016.
  EXPECT_NEAR(r.interval.low, 0.002529 / (1 - 0.002529), 1e-5);
  EXPECT_NEAR(r.interval.high, 0.445016 / (1 - 0.445016), 1e-5);
  const RatioEstimate back = EstimateRateRatio(EstimateRate(9, 50.0), EstimateRate(1, 50.0));
  EXPECT_NEAR(back.interval.high, 1.0 / r.interval.low, 1e-6);
}

TEST(Ratio, ZeroCountsAreHandled) {
  EXPECT_TRUE(std::isnan(EstimateRateRatio(EstimateRate(0, 10.0), EstimateRate(0, 10.0)).ratio));
  const RatioEstimate r = EstimateRateRatio(EstimateRate(0, 10.0), EstimateRate(6, 10.0));
  EXPECT_EQ(r.ratio, 0.0);
  EXPECT_LT(r.interval.high, 1.0);
  EXPECT_TRUE(
      std::isinf(EstimateRateRatio(EstimateRate(6, 10.0), EstimateRate(0, 10.0)).interval.high));
}

TEST(Shares, SeeTerrainsThatTreatTheArmsDifferentlyOnly) {
  // Harder for both arms alike is no heterogeneity; hard for one arm only is.
  const std::vector<PairedCounts> alike = {
      {10, 20, 50, 50}, {1, 2, 50, 50}, {2, 4, 50, 50}, {5, 9, 50, 50}};
  const std::vector<PairedCounts> unlike = {
      {20, 1, 50, 50}, {1, 20, 50, 50}, {15, 2, 50, 50}, {2, 14, 50, 50}};
  EXPECT_GT(CheckShares(alike).p_value, 0.5);
  EXPECT_LT(CheckShares(unlike).p_value, 1e-6);
  // A fall on each of ten terrains cannot tell: chance alone makes the shares 0 and 1.
  std::vector<PairedCounts> single(5, {1, 0, 50, 50});
  single.insert(single.end(), 5, {0, 1, 50, 50});
  EXPECT_NEAR(CheckShares(single).index, 1.0, 1e-12);
}

TEST(Bootstrap, BracketsTheRatioAndRepeats) {
  const std::vector<PairedCounts> terrains = {
      {2, 5, 50, 50}, {3, 8, 50, 50}, {1, 3, 50, 50}, {4, 8, 50, 50}, {2, 4, 50, 50}};
  const RatioEstimate a = BootstrapRateRatio(terrains, 1), b = BootstrapRateRatio(terrains, 1);
  EXPECT_LT(a.interval.low, 12.0 / 28.0);
  EXPECT_GT(a.interval.high, 12.0 / 28.0);
  EXPECT_LT(a.interval.high, 1.0);
  EXPECT_LT(a.p_value, 0.05) << "as its interval says";
  EXPECT_EQ(a.interval.low, b.interval.low);
}

TEST(Bootstrap, SaysNothingOfTooLittle) {
  const std::vector<PairedCounts> two(2, PairedCounts{1, 9, 50, 50}), none(9, {0, 0, 50, 50}),
      alike(9, {1, 9, 50, 50});
  for (const auto& terrains : {two, none, alike}) {
    const RatioEstimate r = BootstrapRateRatio(terrains, 1);
    EXPECT_EQ(r.interval.low, 0.0);
    EXPECT_TRUE(std::isinf(r.interval.high));
    EXPECT_EQ(r.p_value, 1.0);
  }
}

RateComparison CompareSums(const std::vector<PairedCounts>& terrains) {
  PairedCounts sum;
  for (const PairedCounts& t : terrains) sum += t;
  return CompareRates(EstimateRate(sum.events_a, sum.exposure_a),
                      EstimateRate(sum.events_b, sum.exposure_b), terrains);
}

/// Share of 1000 campaigns of 20 terrains for which the answer is yes.
template <class Question>
int CountCampaigns(const test::FallModel& model, int first_seed, Question question) {
  int yes = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto terrains = test::MakeFalls(model, 20, static_cast<std::uint64_t>(first_seed + i));
    if (question(CompareSums(terrains))) ++yes;
  }
  return yes;
}

bool Rejects(const RateComparison& c) { return c.judged.p_value < 0.05; }

// A against A. 66 is what 5 % give at most in 99 of 100 experiments.
TEST(Comparison, OfAWithItselfSeldomFindsADifference) {
  const test::FallModel poisson{.falls = 2.0};
  EXPECT_LE(CountCampaigns(poisson, 1000, Rejects), 66);
  const test::FallModel hard_and_easy{.falls = 2.0, .terrain_shape = 1};
  EXPECT_LE(CountCampaigns(hard_and_easy, 2000, Rejects), 66) << "negative binomial over terrains";
  for (const int shape : {1, 2, 4}) {
    const test::FallModel by_arm{.falls = 2.0, .arm_shape = shape};
    EXPECT_LE(CountCampaigns(by_arm, 3000 * shape, Rejects), 66) << "likewise, by arm: " << shape;
  }
}

// Terrains that treat the arms differently: the exact interval is far too narrow, the one that
// resamples terrains is not.
TEST(Comparison, ByTerrainCoversWhereTheExactIntervalDoesNot) {
  const test::FallModel model{.falls = 3.0, .ratio = 2.0, .arm_shape = 1};
  const int exact = CountCampaigns(
      model, 50000, [](const RateComparison& c) { return c.exact.interval.Contains(2.0); });
  const int judged = CountCampaigns(
      model, 50000, [](const RateComparison& c) { return c.judged.interval.Contains(2.0); });
  EXPECT_LT(exact, 800);
  EXPECT_GE(judged, 934) << "95 % less what chance takes in 99 of 100 experiments";
}

TEST(Comparison, JudgesByTheExactRatioWhereTerrainsAreAlike) {
  const std::vector<PairedCounts> terrains(8, PairedCounts{1, 3, 50, 50});
  const RateComparison c = CompareSums(terrains);
  EXPECT_FALSE(c.over_dispersed);
  EXPECT_EQ(c.judged.p_value, c.exact.p_value);
  EXPECT_EQ(c.judged.interval.high, c.exact.interval.high);
}

}  // namespace
}  // namespace scoria::analysis
