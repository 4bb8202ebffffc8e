// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/power.h"

#include <cmath>

#include <gtest/gtest.h>

#include "analysis/statistics/rate_ratio.h"
#include "core/rng.h"

namespace scoria::analysis {
namespace {

// Detecting a factor of two at one fall per 133.5 m needs about 3 km per arm (peer survey, section
// 0).
TEST(Power, AgreesWithTheSurveysBudget) {
  EXPECT_NEAR(DetectableRatio(1.0 / 133.5, 3100.0), 2.0, 0.15);
  EXPECT_TRUE(std::isinf(DetectableRatio(0.0, 100.0)));
  EXPECT_TRUE(std::isinf(ExposureForRatio(0.0, 2.0)));
  EXPECT_TRUE(std::isinf(ExposureForRatio(0.01, 1.0)));
}

/// Share of 2000 pairs of Poisson counts that the exact test rejects.
double SimulateRatePower(double events, double ratio, double alpha) {
  core::Rng rng(7, 0, core::Stream::kOperator);
  int rejections = 0;
  for (int i = 0; i < 2000; ++i) {
    const RateEstimate a = EstimateRate(rng.NextPoisson(ratio * events), 1.0);
    const RateEstimate b = EstimateRate(rng.NextPoisson(events), 1.0);
    if (EstimateRateRatio(a, b).p_value <= alpha) ++rejections;
  }
  return rejections / 2000.0;
}

TEST(Power, OfRatesIsWhatTheTestAchieves) {
  for (const auto& [events, ratio, alpha] :
       {std::tuple(3.0, 4.0, 0.05), std::tuple(12.0, 2.5, 0.05), std::tuple(40.0, 2.0, 0.001),
        std::tuple(0.5, 20.0, 0.05), std::tuple(200.0, 1.0, 0.05)}) {
    // Three standard errors of the simulation.
    EXPECT_NEAR(RatePower(events, ratio, alpha), SimulateRatePower(events, ratio, alpha), 0.034)
        << events << " " << ratio;
  }
}

TEST(Power, NormalApproximationMeetsTheSum) {
  const double ratio = 1.2, below = RatePower(999.0 / (1.0 + ratio), ratio, 0.05);
  EXPECT_NEAR(below, RatePower(1001.0 / (1.0 + ratio), ratio, 0.05), 0.02);
}

TEST(Power, OfRatesIsInvertedByBudgetAndRatio) {
  for (const TestGoal goal : {TestGoal{0.05, 0.8}, TestGoal{0.01, 0.95}, TestGoal{0.2, 0.5}}) {
    const double exposure = ExposureForRatio(0.02, 3.0, goal);
    EXPECT_NEAR(RatePower(0.02 * exposure, 3.0, goal.alpha), goal.power, 2e-3);
    EXPECT_NEAR(DetectableRatio(0.02, exposure, goal), 3.0, 0.01);
    EXPECT_NEAR(ExposureForRatio(0.06, 1.0 / 3.0, goal), exposure, 1e-3 * exposure)
        << "the same arms";
    EXPECT_NEAR(ExposureForRatio(0.02, 3.0, goal, 2.0), 2.0 * exposure, 1e-3 * exposure);
  }
  EXPECT_GT(DetectableRatio(0.02, 500.0, {0.01, 0.8}), DetectableRatio(0.02, 500.0, {0.05, 0.8}));
}

// Sample sizes for a paired t-test as tabulated by [Cohen1988] and computed by G*Power 3.1.
TEST(Power, OfPairsIsThatOfTables) {
  EXPECT_EQ(PairsForEffect(0.2), 199);
  EXPECT_EQ(PairsForEffect(0.5), 34);
  EXPECT_EQ(PairsForEffect(0.8), 15);
  EXPECT_EQ(PairsForEffect(0.5, {0.05, 0.95}), 54);
  EXPECT_EQ(PairsForEffect(0.0), std::nullopt);
  EXPECT_NEAR(DetectableEffect(34), 0.4949, 1e-3);
  EXPECT_NEAR(PairedPower(0.5, 34, 0.05), 0.8078, 1e-4);
  EXPECT_NEAR(PairedPower(0.0, 10, 0.05), 0.05, 1e-9);
  EXPECT_TRUE(std::isinf(DetectableEffect(1)));
  EXPECT_GT(DetectableEffect(2), 5.0);
}

TEST(Power, OfManyPairsMeetsTheExactOne) {
  for (const double effect : {0.1, 0.15, 0.2})
    EXPECT_NEAR(PairedPower(effect, 300, 0.05), PairedPower(effect, 301, 0.05), 2e-3);
}

}  // namespace
}  // namespace scoria::analysis
