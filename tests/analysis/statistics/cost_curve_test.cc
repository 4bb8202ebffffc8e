// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/cost_curve.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

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

}  // namespace
}  // namespace scoria::analysis
