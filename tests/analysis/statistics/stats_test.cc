// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/stats.h"

#include <cmath>

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
}

TEST(Bootstrap, BracketsTheRatioAndRepeats) {
  const std::vector<PairedCounts> terrains = {
      {2, 4, 50, 50}, {3, 7, 50, 50}, {1, 2, 50, 50}, {4, 8, 50, 50}, {2, 3, 50, 50}};
  const Interval a = BootstrapRateRatio(terrains, 1), b = BootstrapRateRatio(terrains, 1);
  EXPECT_LT(a.low, 0.5);
  EXPECT_GT(a.high, 0.5);
  EXPECT_LT(a.high, 1.0);
  EXPECT_EQ(a.low, b.low);
}

// Detecting a factor of two at one fall per 133.5 m needs about 3 km per arm (peer survey, section
// 0).
TEST(Power, AgreesWithTheSurveysBudget) {
  EXPECT_NEAR(DetectableRatio(1.0 / 133.5, 3100.0), 2.0, 0.15);
  EXPECT_TRUE(std::isinf(DetectableRatio(0.0, 100.0)));
}

/// Points of y = 0.2 / x + 0.4 + 0.3 x in clusters of ten.
std::vector<CurvePoint> CurvePoints() {
  std::vector<CurvePoint> points;
  for (std::size_t i = 0; i < 60; ++i) {
    const double x = 0.2 + 0.02 * static_cast<double>(i);
    points.push_back({x, 0.2 / x + 0.4 + 0.3 * x, i / 10});
  }
  return points;
}

TEST(CostCurve, RecoversItsOwnCurve) {
  const CurveFit fit = FitCostCurve(CurvePoints(), 3, 7);
  ASSERT_TRUE(fit.valid);
  EXPECT_NEAR(fit.a, 0.2, 1e-6);
  EXPECT_NEAR(fit.b, 0.4, 1e-6);
  EXPECT_NEAR(fit.c, 0.3, 1e-6);
  EXPECT_NEAR(fit.r2, 1.0, 1e-9);
  EXPECT_EQ(CostCurveFormula(2), "b + c v");
}

// A tenth of the windows far off bends a least-squares fit by its own size; this one hardly.
TEST(CostCurve, IsNotBentByOutliers) {
  std::vector<CurvePoint> points = CurvePoints();
  for (std::size_t i = 0; i < points.size(); i += 10) points[i].y += 3.0;
  const CurveFit fit = FitCostCurve(points, 3, 7);
  for (std::size_t i = 0; i < fit.x.size(); ++i)
    EXPECT_NEAR(fit.y[i], 0.2 / fit.x[i] + 0.4 + 0.3 * fit.x[i], 0.05);
}

// Six episodes that differ by ±0.2, ten equal windows each: the band must show the spread of six,
// not that of sixty independent points, which would be narrower by the root of ten.
TEST(CostCurve, BandResamplesEpisodes) {
  std::vector<CurvePoint> points;
  for (std::size_t episode = 0; episode < 6; ++episode) {
    for (int k = 0; k < 10; ++k)
      points.push_back({0.5, 1.0 + (episode % 2 == 0 ? 0.2 : -0.2), episode});
  }
  EXPECT_TRUE(FitCostCurve(std::span(points).first(40), 1, 7).low.empty()) << "of four episodes";
  const CurveFit fit = FitCostCurve(points, 1, 7);
  ASSERT_FALSE(fit.low.empty());
  const double half = 0.5 * (fit.high.front() - fit.low.front());
  const double of_six = 1.96 * 0.2 / std::sqrt(6.0);
  EXPECT_GT(half, 0.7 * of_six);
  EXPECT_LT(half, 1.5 * of_six);
}

TEST(Stats, MeanHasStudentsInterval) {
  const MeanEstimate e = EstimateMean(std::vector<double>{1.0, 2.0, 3.0});
  EXPECT_NEAR(e.mean, 2.0, 1e-12);
  EXPECT_NEAR(e.interval.low, 2.0 - 4.302653 / std::sqrt(3.0), 1e-5);
  EXPECT_NEAR(e.interval.high, 2.0 + 4.302653 / std::sqrt(3.0), 1e-5);
  EXPECT_TRUE(std::isinf(EstimateMean(std::vector<double>{1.0}).interval.high));
}

}  // namespace
}  // namespace scoria::analysis
