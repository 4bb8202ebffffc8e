// SPDX-License-Identifier: BSD-3-Clause
#include "app/check/judge_arms.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace scoria::app {
namespace {

using analysis::CampaignResults;
using analysis::EpisodeRecord;

void AddWalk(CampaignResults& results, const std::string& arm, std::uint64_t seed, int falls,
             double height_m) {
  EpisodeRecord& e = results.episodes.emplace_back();
  e.arm = arm;
  e.seed = seed;
  e.has_metrics = true;
  e.metrics.outcome.emplace();
  e.metrics.outcome->falls = falls;
  e.metrics.distance_m = 100.0;
  e.metrics.tracking.samples_s = 10.0;
  e.metrics.tracking.height_rmse_m = height_m;
}

/// On ten seeds, a falls never and b as often as `falls` says; b stands 3 mm worse, give or take
/// half a millimetre.
CampaignResults MadeUp(const std::array<int, 10>& falls) {
  CampaignResults results;
  results.arms = {"a", "b"};
  for (std::uint64_t seed = 0; seed < falls.size(); ++seed) {
    const double height_m = 0.01 + 0.001 * static_cast<double>(seed);
    AddWalk(results, "a", seed, seed == 0 ? 1 : 0, height_m);
    AddWalk(results, "b", seed, falls[seed], height_m + (seed % 2 == 0 ? 0.0025 : 0.0035));
  }
  return results;
}

/// What is wrong with `compare` of `name`; empty if nothing is.
std::string ProblemOf(const std::string& name, const ArmComparison& compare,
                      const CampaignResults& results) {
  ArmBounds bounds;
  bounds.compare = {compare};
  const std::vector<Finding> findings = JudgeArms({{name, bounds}}, results);
  EXPECT_EQ(findings.size(), 1u);
  return findings.front().problem;
}

// Of 21 falls, one is of a: the exact upper bound of its share at 95 % is 0.2067, a ratio of
// 0.2606.
TEST(JudgeArms, ARatioHasToBeShown) {
  const CampaignResults results = MadeUp({2, 2, 2, 2, 2, 2, 2, 2, 2, 2});
  ArmComparison c{"a", "b", 0.261, {}, {}, {}, 0.95};
  EXPECT_EQ(ProblemOf("falls_per_m", c, results), "");
  c.ratio_below = 0.26;
  EXPECT_EQ(ProblemOf("falls_per_m", c, results),
            "is 0.05, below 0.2606 with 95 % confidence; must be below 0.26");
  c.ratio_below = 0.261;
  c.confidence = 0.99;
  EXPECT_NE(ProblemOf("falls", c, results), "") << "not with more confidence";
  EXPECT_EQ(ProblemOf("falls", {"b", "a", {}, 3.8, {}, {}, 0.95}, results), "");
  EXPECT_NE(ProblemOf("falls", {"b", "a", {}, 3.9, {}, {}, 0.95}, results), "");
}

// The same falls on one terrain of ten say less.
TEST(JudgeArms, ARatioIsJudgedByTerrainWhereTerrainsTreatTheArmsDifferently) {
  const CampaignResults results = MadeUp({0, 0, 0, 20, 0, 0, 0, 0, 0, 0});
  EXPECT_NE(ProblemOf("falls", {"a", "b", 0.5, {}, {}, {}, 0.95}, results), "");
}

// Differences of 2.5 and 3.5 mm, five each: 3 mm, standard error 0.527 / √10 mm, t = 1.833.
TEST(JudgeArms, ADifferenceIsPairedBySeed) {
  const CampaignResults results = MadeUp({});
  ArmComparison c{"b", "a", {}, {}, 3.31, {}, 0.95};
  EXPECT_EQ(ProblemOf("height_rmse_mm", c, results), "");
  c.difference_below = 3.3;
  EXPECT_EQ(ProblemOf("height_rmse_mm", c, results),
            "is 3, below 3.306 with 95 % confidence; must be below 3.3");
  EXPECT_EQ(ProblemOf("height_rmse_m", {"a", "b", {}, {}, {}, -0.00331, 0.95}, results), "");
  EXPECT_NE(ProblemOf("height_rmse_m", {"a", "b", {}, {}, {}, -0.0033, 0.95}, results), "");
}

TEST(JudgeArms, ADifferenceNeedsTwoSeeds) {
  CampaignResults results = MadeUp({});
  results.episodes.resize(2);
  EXPECT_EQ(ProblemOf("height_rmse_mm", {"b", "a", {}, {}, 1e3, {}, 0.95}, results),
            "needs two seeds with a value of both arms at least");
}

TEST(JudgeArms, BoundsAreOfTheArmsThatAreNamed) {
  const CampaignResults results = MadeUp({2, 2, 2, 2, 2, 2, 2, 2, 2, 2});
  ArmBounds bounds;
  bounds.max = 5;
  EXPECT_EQ(JudgeArms({{"falls", bounds}}, results).size(), 2u);
  bounds.arms = {"b"};
  const std::vector<Finding> findings = JudgeArms({{"falls", bounds}}, results);
  ASSERT_EQ(findings.size(), 1u);
  EXPECT_EQ(findings[0].name, "falls of b");
  EXPECT_EQ(findings[0].problem, "is 20, must be at most 5");
}

}  // namespace
}  // namespace scoria::app
