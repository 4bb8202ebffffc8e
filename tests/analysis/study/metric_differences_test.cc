// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/metric_differences.h"

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "analysis/report/report.h"
#include "analysis/study/compare.h"
#include "core/rng.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

EpisodeRecord Walked(const std::string& arm, std::uint64_t seed, double height_rmse_m) {
  EpisodeRecord e;
  e.id = fmt::format("{}-{}", arm, seed);
  e.arm = arm;
  e.seed = seed;
  e.end = "completed";
  e.has_metrics = true;
  e.metrics.outcome.emplace();
  e.metrics.distance_m = 50.0;
  e.metrics.tracking.samples_s = 10.0;
  e.metrics.tracking.height_rmse_m = height_rmse_m;
  return e;
}

/// Arm b is 3, 4 and 5 mm better on seeds 1 to 3; c walked seed 1 alone, and another.
CampaignResults MadeUp() {
  CampaignResults results;
  results.arms = {"a", "b", "c"};
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const double a_m = 0.010 + 0.001 * static_cast<double>(seed);
    results.episodes.push_back(Walked("a", seed, a_m));
    results.episodes.push_back(Walked("b", seed, a_m - 0.002 - 0.001 * static_cast<double>(seed)));
  }
  results.episodes.push_back(Walked("c", 1, 0.02));
  results.episodes.push_back(Walked("c", 9, 0.5));
  return results;
}

TEST(MetricDifferences, PairEpisodesOfTheSameSeed) {
  const std::vector<ArmDifferences> all = AllDifferences(MadeUp(), AllMetrics());
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].arm, "b");
  EXPECT_EQ(all[0].baseline, "a");
  const MetricDifference* b = all[0].Find("height_rmse_m");
  ASSERT_NE(b, nullptr);
  EXPECT_EQ(b->pairs.difference.count, 3u);
  EXPECT_NEAR(b->pairs.mean_b, 0.012, 1e-12);
  EXPECT_NEAR(b->pairs.difference.mean, -0.004, 1e-12);
  // Differences of -3, -4 and -5 mm.
  EXPECT_NEAR(b->pairs.difference.interval.high, -0.004 + 0.001 * 2.484, 1e-5);
  // Student's p of t = 4 √3 with two degrees of freedom is 0.0202: not enough among several.
  EXPECT_GT(b->holm, 0.05);
  EXPECT_EQ(Judge(*b), Judgement::kNoneShown);
  const MetricDifference* c = all[1].Find("height_rmse_m");
  ASSERT_NE(c, nullptr);
  EXPECT_EQ(c->pairs.difference.count, 1u) << "seed 9 has no partner";
  EXPECT_NEAR(c->pairs.difference.mean, 0.009, 1e-12);
  EXPECT_EQ(Judge(*c), Judgement::kNoneShown) << "of one seed";
  EXPECT_EQ(all[0].Find("roll_rmse_rad"), nullptr) << "nobody measured it";
}

TEST(MetricDifferences, DirectionsDecideWhatIsBetter) {
  MetricDifference d;
  d.pairs.difference = {3, 1.0, {0.5, 1.5}, 0.1};
  d.holm = 0.05;
  d.metric.better = Better::kHigher;
  EXPECT_EQ(Judge(d), Judgement::kBetter);
  d.metric.better = Better::kLower;
  EXPECT_EQ(Judge(d), Judgement::kWorse);
  d.metric.better = Better::kNeither;
  EXPECT_EQ(Judge(d), Judgement::kNoDirection);
  d.metric.better = Better::kLower;
  d.holm = 0.051;
  EXPECT_EQ(Judge(d), Judgement::kNoneShown);
}

// Arms that differ in nothing but chance: some metric of dozens nearly always has an interval
// beside zero.
TEST(MetricDifferences, AreJudgedAmongAllOfTheirComparison) {
  int judged = 0, beside_zero = 0;
  constexpr int kCampaigns = 100;
  for (std::uint64_t campaign = 0; campaign < kCampaigns; ++campaign) {
    core::Rng rng(campaign, 0, core::Stream::kOperator);
    CampaignResults results;
    results.arms = {"a", "b"};
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      for (const std::string& arm : results.arms) {
        EpisodeRecord e = Walked(arm, seed, 0.02 + 0.001 * rng.NextNormal());
        e.metrics.tracking.roll_rmse_rad = 0.02 + 0.001 * rng.NextNormal();
        e.metrics.tracking.pitch_rmse_rad = 0.02 + 0.001 * rng.NextNormal();
        results.episodes.push_back(std::move(e));
      }
    }
    const ArmDifferences all = AllDifferences(results, AllMetrics()).front();
    const auto is_judged = [](const MetricDifference& d) {
      return Judge(d) == Judgement::kBetter || Judge(d) == Judgement::kWorse;
    };
    const auto is_beside_zero = [](const MetricDifference& d) {
      return !d.pairs.difference.interval.Contains(0.0);
    };
    judged += std::ranges::any_of(all.metrics, is_judged) ? 1 : 0;
    beside_zero += std::ranges::any_of(all.metrics, is_beside_zero) ? 1 : 0;
  }
  EXPECT_LE(judged, 9) << "5 % and twice the deviation of a binomial count";
  EXPECT_GT(beside_zero, judged);
}

TEST(Compare, ArmsWithoutMetresAreNotCompared) {
  CampaignResults results = MadeUp();
  for (EpisodeRecord& e : results.episodes) {
    if (e.arm == "b") e.metrics.outcome.reset();
  }
  EXPECT_EQ(Compare(results, "a", "b", {}).verdict,
            "Whole sweep: falls of a and b are not compared: b has no metres.");
  EXPECT_EQ(MetresPerFall(PoolCell(results, "b", {})), "–");
}

TEST(MetricDifferences, AreATableOfTheReport) {
  const test::TemporaryFolder folder;
  const Document d = ComposeReport(MakeReportInput(folder.path(), MadeUp(), std::nullopt));
  for (const Chapter& chapter : d.chapters) {
    if (chapter.key != "differences") continue;
    EXPECT_EQ(std::get<Heading>(chapter.blocks.at(0)).text, "b against a");
    EXPECT_EQ(std::get<Paragraph>(chapter.blocks.at(1)).text.find("b against a: "), 0u);
    const Table& table = std::get<Table>(chapter.blocks.at(2));
    const std::vector<std::string> line = {
        "height RMSE [mm]",          "3",     "8.0",        "12.0",
        "-4.0 (95 %: -6.5 to -1.5)", "lower", "no evidence"};
    const auto begins = [&](const std::vector<std::string>& row) {
      return std::equal(line.begin(), line.end(), row.begin());
    };
    EXPECT_EQ(std::count_if(table.rows.begin(), table.rows.end(), begins), 1);
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.header.size());
    return;
  }
  FAIL() << "no such section";
}

}  // namespace
}  // namespace scoria::analysis
