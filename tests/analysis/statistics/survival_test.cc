// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/survival.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/statistics/log_rank.h"

namespace scoria::analysis {
namespace {

/// A patient of the trial of 6-mercaptopurine: weeks in remission, relapse seen, logarithm of the
/// white blood cells. Source: Freireich et al., Blood 21, 1963, as in Kleinbaum and Klein, Survival
/// analysis, 3rd edition, 2012, tables 1.1, 2.1 and chapter 2.
struct Patient {
  double weeks;
  bool relapse;
  double log_cells;
};
const std::vector<Patient> kTreated = {
    {6, true, 2.31},   {6, true, 4.06},   {6, true, 3.28},   {7, true, 4.43},   {10, true, 2.96},
    {13, true, 2.88},  {16, true, 3.60},  {22, true, 2.32},  {23, true, 2.57},  {6, false, 3.20},
    {9, false, 2.80},  {10, false, 2.70}, {11, false, 2.60}, {17, false, 2.16}, {19, false, 2.05},
    {20, false, 2.01}, {25, false, 1.78}, {32, false, 2.20}, {32, false, 2.53}, {34, false, 1.47},
    {35, false, 1.45}};
const std::vector<Patient> kPlacebo = {
    {1, true, 2.80},  {1, true, 5.00},  {2, true, 4.91},  {2, true, 4.48},  {3, true, 4.01},
    {4, true, 4.36},  {4, true, 2.42},  {5, true, 3.49},  {5, true, 3.97},  {8, true, 3.52},
    {8, true, 3.05},  {8, true, 2.32},  {8, true, 3.26},  {11, true, 3.49}, {11, true, 2.12},
    {12, true, 1.50}, {12, true, 3.06}, {15, true, 2.30}, {17, true, 2.95}, {22, true, 2.73},
    {23, true, 1.97}};

std::vector<Lifetime> Lifetimes(const std::vector<Patient>& patients, double above = -1.0,
                                double to = 10.0) {
  std::vector<Lifetime> lifetimes;
  for (const Patient& p : patients) {
    if (p.log_cells > above && p.log_cells <= to) lifetimes.push_back({p.weeks, p.relapse});
  }
  return lifetimes;
}

TEST(Survival, IsThatOfAPublishedExample) {
  const SurvivalCurve curve = EstimateSurvival(Lifetimes(kTreated));
  const double weeks[] = {6, 7, 10, 13, 16, 22, 23};
  const long at_risk[] = {21, 17, 15, 12, 11, 7, 6};
  const double survival[] = {0.8571, 0.8067, 0.7529, 0.6902, 0.6275, 0.5378, 0.4482};
  ASSERT_EQ(curve.steps.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(curve.steps[i].length, weeks[i]);
    EXPECT_EQ(curve.steps[i].at_risk, at_risk[i]);
    EXPECT_NEAR(curve.steps[i].survival, survival[i], 5e-5);
  }
  EXPECT_EQ(curve.Median(), 23.0);
  EXPECT_EQ(curve.censored.size(), 12u);
  EXPECT_EQ(curve.end, 35.0);
  // S^exp(±1.96 · 0.0764 / (S |log S|)), with the published standard error.
  const double spread = 1.959964 * 0.07636 / (0.857143 * -std::log(0.857143));
  EXPECT_NEAR(curve.steps[0].band.low, std::pow(0.857143, std::exp(spread)), 1e-4);
  EXPECT_NEAR(curve.steps[0].band.high, std::pow(0.857143, std::exp(-spread)), 1e-4);
}

TEST(Survival, EndsAtZeroWhereTheLastFell) {
  const SurvivalCurve curve = EstimateSurvival(Lifetimes(kPlacebo));
  EXPECT_EQ(curve.Median(), 8.0);
  EXPECT_EQ(curve.steps.back().survival, 0.0);
  EXPECT_EQ(curve.steps.back().band.low, 0.0);
  EXPECT_GT(curve.steps.back().band.high, 0.0);
  EXPECT_TRUE(EstimateSurvival(std::vector<Lifetime>{{5.0, false}}).steps.empty());
  EXPECT_FALSE(EstimateSurvival(std::vector<Lifetime>{{5.0, false}}).Median());
}

TEST(LogRank, IsThatOfAPublishedExample) {
  const std::vector<SurvivalStratum> all = {{Lifetimes(kTreated), Lifetimes(kPlacebo)}};
  const LogRank r = TestLogRank(all);
  EXPECT_EQ(r.observed_a, 9.0);
  EXPECT_NEAR(r.expected_a, 19.25, 0.005);
  EXPECT_NEAR(r.expected_b, 10.75, 0.005);
  EXPECT_NEAR(r.chi2, 16.79, 0.005);
  EXPECT_NEAR(r.p_value, 4.17e-5, 1e-6);
}

// Strata of white blood cells up to 2.30, up to 3.00 and above.
TEST(LogRank, StratifiedIsThatOfAPublishedExample) {
  std::vector<SurvivalStratum> strata;
  for (const auto& [above, to] :
       {std::pair(-1.0, 2.30), std::pair(2.30, 3.0), std::pair(3.0, 10.0)})
    strata.push_back({Lifetimes(kTreated, above, to), Lifetimes(kPlacebo, above, to)});
  const LogRank r = TestLogRank(strata);
  EXPECT_EQ(r.observed_a, 9.0);
  EXPECT_NEAR(r.chi2, 10.14, 0.005);
  EXPECT_NEAR(r.p_value, 0.0014, 0.0001);
}

TEST(LogRank, HasNothingToSayWithoutEventsOrPartners) {
  const std::vector<SurvivalStratum> strata = {{{{5.0, false}}, {{5.0, false}}},
                                               {{{3.0, true}, {4.0, true}}, {}}};
  EXPECT_EQ(TestLogRank(strata).p_value, 1.0);
}

}  // namespace
}  // namespace scoria::analysis
