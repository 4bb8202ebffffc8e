// SPDX-License-Identifier: BSD-3-Clause
// Statistics as studies and reports use them, on made-up campaigns.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/report/plain_text.h"
#include "analysis/report/report.h"
#include "analysis/study/factor_effects.h"
#include "analysis/study/lifetimes.h"
#include "analysis/study/verdicts.h"
#include "core/rng.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

EpisodeRecord Walked(const std::string& arm, std::uint64_t seed, int falls) {
  EpisodeRecord e;
  e.id = fmt::format("{}-{}", arm, seed);
  e.arm = arm;
  e.seed = seed;
  e.ground = std::to_string(seed);
  e.end = "completed";
  e.has_metrics = true;
  e.metrics.outcome.emplace();
  e.metrics.outcome->falls = falls;
  e.metrics.distance_m = 50.0;
  if (falls > 0) e.metrics.first_fall_m = 10.0 + static_cast<double>(seed);
  e.metrics.tracking.samples_s = 10.0;
  e.metrics.tracking.height_rmse_m = 0.010 + 0.001 * static_cast<double>(seed % 3);
  return e;
}

/// Arms a and b fall alike, c on every ground.
CampaignResults ThreeArms() {
  CampaignResults results;
  results.name = "three";
  results.arms = {"a", "b", "c"};
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    results.episodes.push_back(Walked("a", seed, seed == 1 ? 1 : 0));
    results.episodes.push_back(Walked("b", seed, seed == 2 ? 1 : 0));
    results.episodes.push_back(Walked("c", seed, 2));
    *results.episodes.back().metrics.tracking.height_rmse_m +=
        0.005 + 0.0001 * static_cast<double>(seed);
  }
  return results;
}

Document Compose(const CampaignResults& results) {
  const test::TemporaryFolder folder;
  return ComposeReport(MakeReportInput(folder.path(), results, std::nullopt));
}

const Chapter& Find(const Document& document, const std::string& key) {
  const auto found = std::find_if(document.chapters.begin(), document.chapters.end(),
                                  [&](const Chapter& c) { return c.key == key; });
  EXPECT_NE(found, document.chapters.end()) << key;
  return *found;
}

TEST(Verdicts, SayWhetherThereIsEvidence) {
  const CampaignResults results = ThreeArms();
  const std::vector<Comparison> all = AllComparisons(results);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].verdict.find("Whole sweep: no evidence that a falls more or less than b: a fell "
                                "once in 400 m, b once in 400 m, rate ratio 1.00 (95 %: 0.01 to "
                                "78.50); this budget would have seen a ratio of "),
            0u)
      << all[0].verdict;
  EXPECT_EQ(all[1].verdict.find("Whole sweep: a falls less than c: a fell once in 400 m, c 16 "
                                "times in 400 m, rate ratio 0.06 (95 %: "),
            0u)
      << all[1].verdict;
  EXPECT_FALSE(ShowsDifference(all[0]));
  EXPECT_TRUE(ShowsDifference(all[1]));
  EXPECT_NEAR(all[1].holm, 2.0 * all[1].rates.judged.p_value, 1e-12) << "two comparisons";
  EXPECT_LT(all[1].p_any_time, 0.05);
  EXPECT_GT(all[0].p_any_time, 0.3);
}

TEST(Verdicts, FirstScreenSaysNoEvidenceOnce) {
  CampaignResults results = ThreeArms();
  for (EpisodeRecord& e : results.episodes) {
    if (e.arm == "c") e.metrics.outcome->falls = e.seed == 3 ? 1 : 0;
  }
  const Document d = Compose(results);
  std::string head;
  for (const Block& block : d.head.text) {
    if (const auto* list = std::get_if<BulletList>(&block))
      head += fmt::format("{}\n", fmt::join(list->items, "\n"));
  }
  const std::string text = "no evidence of a difference in falls: a against b: ";
  EXPECT_NE(head.find(text), std::string::npos) << head;
  EXPECT_NE(head.find("; a against c: "), std::string::npos);
  EXPECT_EQ(head.find("no evidence that"), std::string::npos);
}

TEST(Verdicts, NameMetricsThatStandCorrection) {
  const std::vector<ArmDifferences> all = AllDifferences(ThreeArms(), AllMetrics());
  EXPECT_EQ(MetricVerdict(all[0]).find("b against a: no evidence of a difference in "), 0u)
      << MetricVerdict(all[0]);
  EXPECT_EQ(MetricVerdict(all[1]).find("c against a: worse in "), 0u) << MetricVerdict(all[1]);
  EXPECT_NE(MetricVerdict(all[1]).find("height RMSE"), std::string::npos);
  EXPECT_NE(MetricVerdict(all[1]).find(" other metrics (5 %, Holm)."), std::string::npos);
  EXPECT_EQ(MetricVerdict({"b", "a", {}, {}}), "");
}

TEST(Lifetimes, CensorEpisodesThatDidNotFall) {
  CampaignResults results = ThreeArms();
  std::vector<Lifetime> a = LifetimesOf(results, "a", {});
  ASSERT_EQ(a.size(), 8u);
  EXPECT_EQ(a[0].length, 11.0);
  EXPECT_TRUE(a[0].event);
  EXPECT_EQ(a[1].length, 50.0);
  EXPECT_FALSE(a[1].event);
  // By hand: on each of eight grounds c falls first, but a with it on the first, where both fall at
  // 11 m. Expected of a: 8 times a half, and a half more where two fall at once.
  const LogRank r = CompareLifetimes(results, "a", "c", {});
  EXPECT_EQ(r.observed_a, 1.0);
  EXPECT_NEAR(r.expected_a, 7 * 0.5 + 1.0, 1e-12);
  EXPECT_NEAR(r.chi2, 3.5 * 3.5 / (7 * 0.25), 1e-12) << "nothing varies on the first";
  results.episodes[0].metrics.first_fall_m.reset();
  a = LifetimesOf(results, "a", {});
  EXPECT_EQ(a.size(), 7u) << "an older result does not say where it fell";
}

TEST(StatisticsSections, ShowRatiosPowerAndSurvival) {
  const Document d = Compose(ThreeArms());
  const Chapter& ratios = Find(d, "rate_ratios");
  const Table& table = std::get<Table>(ratios.blocks.at(0));
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[1][0], "all");
  EXPECT_EQ(table.rows[1][1], "a : c");
  EXPECT_EQ(table.rows[1][2], "1 in 400 m, 16 in 400 m");
  const Table& power = std::get<Table>(ratios.blocks.at(2));
  EXPECT_EQ(power.rows[1][2], "400");
  EXPECT_GT(std::stod(power.rows[1][4]), std::stod(power.rows[1][5])) << "smaller takes more";
  const Chapter& survival = Find(d, "survival");
  EXPECT_EQ(
      std::get<BulletList>(survival.blocks.at(0)).items.at(0).find("No evidence that a and b"), 0u);
  EXPECT_EQ(std::get<BulletList>(survival.blocks.at(0)).items.at(1).find("a walks farther than c"),
            0u);
  const Table& medians = std::get<Table>(survival.blocks.at(2));
  EXPECT_EQ(medians.rows[0], (std::vector<std::string>{"a", "8", "1", "> 50.0"}));
  EXPECT_EQ(medians.rows[2], (std::vector<std::string>{"c", "8", "8", "14.0"}));
}

TEST(StatisticsSections, PowerIsOfTheGoalThatWasAskedFor) {
  const test::TemporaryFolder folder;
  const auto detectable = [&](const TestGoal& goal) {
    return MakeReportInput(folder.path(), ThreeArms(), std::nullopt, AllMetrics(), goal)
        .comparisons[1]
        .detectable;
  };
  EXPECT_LT(detectable({0.05, 0.5}), detectable({0.05, 0.8}));
  EXPECT_LT(detectable({0.05, 0.8}), detectable({0.01, 0.8}));
}

/// A campaign over a design, whose height error is Ishigami's function of three factors.
CampaignResults Designed(std::size_t points) {
  CampaignResults results;
  results.name = "design";
  results.arms = {"a"};
  std::vector<Factor> factors;
  for (const char* key : {"x", "y", "z"})
    factors.push_back({key, key, -std::numbers::pi, std::numbers::pi});
  results.design = MakeDesign(DesignKind::kSobol, factors, points, 1);
  for (const std::vector<std::string>& point : results.design->points) {
    EpisodeRecord e = Walked("a", 1, 0);
    e.id = fmt::format("a-{}", results.episodes.size());
    e.point = point;
    const double x = std::stod(point[0]), y = std::stod(point[1]), z = std::stod(point[2]);
    e.metrics.tracking.height_rmse_m =
        std::sin(x) + 7.0 * std::pow(std::sin(y), 2) + 0.1 * std::pow(z, 4) * std::sin(x);
    results.episodes.push_back(e);
  }
  return results;
}

TEST(Design, PointsLieWithinTheirRangesInWholeRows) {
  const Design design =
      MakeDesign(DesignKind::kLatinHypercube,
                 {{"a.b", "b", 1.0, 100.0, FactorScale::kLog}, {"c", "c", -1.0, 1.0}}, 63, 3);
  ASSERT_EQ(design.points.size(), 60u) << "rows of four";
  int low = 0;
  for (const auto& point : design.points) {
    const double b = std::stod(point[0]), c = std::stod(point[1]);
    EXPECT_GE(b, 1.0);
    EXPECT_LE(b, 100.0);
    EXPECT_LE(std::abs(c), 1.0);
    if (b < 10.0) ++low;
  }
  EXPECT_NEAR(low, 30, 6) << "even in the logarithm";
  const Design read = DesignFromJson(ToJson(design));
  EXPECT_EQ(read.points, design.points);
  EXPECT_EQ(read.kind, design.kind);
  EXPECT_EQ(read.factors[0].scale, FactorScale::kLog);
}

TEST(FactorEffects, AreTheKnownIndices) {
  const CampaignResults results = Designed(5 * 2048);
  const auto all = CalcFactorEffects(results, "a", AllMetrics());
  const auto height = std::find_if(all.begin(), all.end(), [](const FactorEffects& e) {
    return e.metric.key == "height_rmse_m";
  });
  ASSERT_NE(height, all.end());
  EXPECT_EQ(height->rows, 2048u);
  const double total[] = {0.5576, 0.4424, 0.2437};
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(height->indices[k].total, total[k], 0.05 * total[k]);
}

TEST(FactorEffects, LeaveOutRowsThatLackAnEpisode) {
  CampaignResults results = Designed(5 * 8);
  results.episodes[7].has_metrics = false;
  const auto all = CalcFactorEffects(results, "a", AllMetrics());
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all[0].rows, 7u);
}

TEST(FactorEffects, AreASectionOfTheReport) {
  CampaignResults results = Designed(5 * 16);
  const Document d = Compose(results);
  const Chapter& factors = Find(d, "factors");
  int figures = 0, tables = 0;
  for (const Block& block : factors.blocks) {
    figures += std::holds_alternative<CaptionedFigure>(block) ? 1 : 0;
    tables += std::holds_alternative<Table>(block) ? 1 : 0;
  }
  EXPECT_GE(figures, 1);
  EXPECT_EQ(tables, 1);
  EXPECT_NE(std::get<Paragraph>(d.head.text.at(0)).text.find("a over 80 points of x (-3.14159"),
            std::string::npos)
      << std::get<Paragraph>(d.head.text.at(0)).text;
  const Chapter& numbers = Find(d, "numbers");
  EXPECT_EQ(std::get<Table>(numbers.blocks.at(0)).rows.size(), 1u) << "points are pooled";
}

TEST(FactorEffects, BinsHoldEquallyManyPoints) {
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i < 40; ++i) points.push_back({39.0 - i, 2.0 * (39.0 - i)});
  const auto means = BinnedResponse(points);
  ASSERT_EQ(means.size(), 8u);
  EXPECT_NEAR(means[0][0], 2.0, 1e-12);
  EXPECT_NEAR(means[7][1], 74.0, 1e-12);
  EXPECT_TRUE(BinnedResponse({}).empty());
}

}  // namespace
}  // namespace scoria::analysis
