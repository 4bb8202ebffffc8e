// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/registry.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/metric_text.h"
#include "analysis/metrics/metrics.h"
#include "analysis/report/metric_files.h"
#include "analysis/report/plain_text.h"
#include "analysis/report/report.h"
#include "core/files.h"
#include "tests/analysis/metrics/example_metric.h"
#include "tests/support/robots.h"
#include "tests/support/rows.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;
using logs::RowGroup;

TEST(Registry, EveryMetricIsWhole) {
  std::set<std::string_view> keys, titles;
  for (const Metric& m : AllMetrics()) {
    EXPECT_TRUE(keys.insert(m.info.key).second) << m.info.key;
    EXPECT_TRUE(titles.insert(m.info.title).second) << m.info.title;
    EXPECT_TRUE(m.info.definition.ends_with('.')) << m.info.key;
    EXPECT_NE(m.find == nullptr, m.make == nullptr) << m.info.key << " has one source";
    EXPECT_GT(m.info.scale, 0.0) << m.info.key;
    const bool named = m.info.unit.empty() || std::isalpha(m.info.unit[0]) == 0 ||
                       m.info.key.find('_') != std::string_view::npos;
    EXPECT_TRUE(named) << m.info.key;
  }
}

TEST(Registry, DocsTableIsCurrent) {
  const std::string page = core::ReadText(test::SourcePath("docs/METRICS.md"));
  EXPECT_NE(page.find("\n\n" + MetricsMarkdown(AllMetrics())), std::string::npos)
      << "put there what this prints: build/release/bin/scoria schema --metrics";
}

/// A metric of which an episode's value is its distance, and the weight its duration.
Metric Made(Pooling pooling) {
  return {.info = {.key = "made", .pooling = pooling},
          .find = [](const EpisodeMetrics& m) -> std::optional<Measured> {
            if (m.duration_s == 0.0) return std::nullopt;
            return Measured{m.distance_m, m.duration_s};
          }};
}

TEST(Registry, PoolsAsTheMetricSays) {
  EpisodeMetrics a, b, unmeasured;
  a.distance_m = 3.0;
  a.duration_s = 1.0;
  b.distance_m = 5.0;
  b.duration_s = 3.0;
  unmeasured.distance_m = 100.0;
  const std::vector<const EpisodeMetrics*> all = {&a, &b, &unmeasured};
  EpisodeMetrics sum = a;
  sum += b;
  const auto pooled = [&](Pooling pooling) {
    return Find(PoolValues({Made(pooling)}, sum, all), "made").value();
  };
  EXPECT_EQ(pooled(Pooling::kSum), 8.0);
  EXPECT_EQ(pooled(Pooling::kMean), 4.5);
  EXPECT_NEAR(pooled(Pooling::kRms), std::sqrt((9.0 + 75.0) / 4.0), 1e-12);
  EXPECT_EQ(pooled(Pooling::kLargest), 5.0);
  EXPECT_EQ(pooled(Pooling::kAccumulated), 8.0) << "of the sum";
  const std::vector<const EpisodeMetrics*> none = {&unmeasured};
  EXPECT_TRUE(PoolValues({Made(Pooling::kMean)}, unmeasured, none).empty());
}

TEST(Registry, WhatRowsLackIsSaidInWords) {
  MetricsAccumulator accumulator(9.81);
  logs::Row row = test::WholeRow();
  row.truth.reset();
  row.true_mass.reset();
  row.energy.reset();
  accumulator.AddRow(row);
  const EpisodeMetrics m = accumulator.Finish();
  const Metrics all = AllMetrics();
  EXPECT_EQ(DescribeMissing(Groups({RowGroup::kTruth})), "the log has no truth");
  const Metric* cost = FindMetric(all, "cot_mech_abs");
  ASSERT_NE(cost, nullptr);
  EXPECT_FALSE(ValueOf(*cost, m));
  EXPECT_EQ(DescribeMissing(MissingGroups(cost->info.needs, m.groups)),
            "the log has no truth, true_mass and energy");
  EXPECT_EQ(DescribeNotValid({*cost}, m.groups),
            (std::vector<std::string>{"CoT mech_abs: not valid here: the log has no truth, "
                                      "true_mass and energy"}));
  EXPECT_NE(DescribeMetrics(all, m).find("\n  falls, falls per metre, stuck, distance"),
            std::string::npos)
      << DescribeMetrics(all, m);
}

TEST(Registry, OlderResultsDoNotSayWhatTheirRowsHad) {
  EpisodeMetrics m;
  m.cot = {0.5, 0.3, 2.0, 2.2};
  m.groups = GroupsOf(test::WholeRow());
  nlohmann::json j = m;
  j.erase("groups");
  j.erase("measured");
  j["peak_foot_force_N"] = 0.0;  // there, what was not measured was zero
  j["mpc"] = {{"median_s", 0.0}, {"p99_s", 0.0}, {"max_s", 0.0}, {"count", 0}};
  const auto older = j.get<EpisodeMetrics>();
  const MetricValues values = ValuesOf(AllMetrics(), older);
  EXPECT_EQ(Find(values, "cot_mech_abs"), 0.5);
  EXPECT_FALSE(Find(values, "peak_foot_force_N"));
  EXPECT_FALSE(Find(values, "mpc_median_s"));
  EXPECT_TRUE(DescribeNotValid(AllMetrics(), older.groups).empty());
}

/// Two arms of one episode each, whose metrics are of rows with these currents.
CampaignResults Measure(const Metrics& metrics, const std::vector<double>& currents_A) {
  CampaignResults results;
  results.name = "made up";
  results.arms = {"a", "b"};
  for (std::size_t i = 0; i < currents_A.size(); ++i) {
    MetricsAccumulator accumulator(9.81, metrics);
    logs::Row row = test::WholeRow();
    row.measured->battery_A = currents_A[i];
    accumulator.AddRow(row);
    EpisodeRecord& e = results.episodes.emplace_back();
    e.id = fmt::format("e{}", i);
    e.arm = results.arms[i % 2];
    e.seed = i / 2;
    e.end = "completed";
    e.has_metrics = true;
    e.metrics = accumulator.Finish();
  }
  return results;
}

// What docs/add_a_metric.md promises.
TEST(ExampleMetric, AppearsInJsonCsvReportComparisonsAndDocs) {
  Metrics metrics = AllMetrics();
  metrics.push_back(PeakCurrentMetric());
  const test::TemporaryFolder folder;
  const CampaignResults results = Measure(metrics, {7.0, 9.0, 8.0, 10.5});

  const nlohmann::json episode = results.episodes[1].metrics;
  EXPECT_EQ(episode.at("measured").at("peak_current_A").at("value"), 9.0);
  EXPECT_EQ(episode.get<EpisodeMetrics>().measured, results.episodes[1].metrics.measured);
  EXPECT_EQ(ToJson(metrics, ValuesOf(metrics, results.episodes[1].metrics)).at("peak_current_A"),
            9.0);

  const ReportInput input = MakeReportInput(folder.path(), results, std::nullopt, metrics);
  WriteMetricFiles(input, folder.path());
  const std::string csv = core::ReadText(folder.path() / "metrics.csv");
  EXPECT_NE(csv.find(",peak_current_A\n"), std::string::npos);
  EXPECT_NE(csv.find(",10.5\n"), std::string::npos);
  const auto json = nlohmann::json::parse(core::ReadText(folder.path() / "metrics.json"));
  EXPECT_EQ(json.at("cells").at(1).at("peak_current_A"), 10.5);
  const nlohmann::json& compared = json.at("comparisons").at(0).at("metrics").back();
  EXPECT_EQ(compared.at("key"), "peak_current_A");
  EXPECT_EQ(compared.at("difference"), 2.25);
  EXPECT_EQ(compared.at("better"), "lower");

  const std::string text = ToPlainText(ComposeReport(input));
  EXPECT_NE(text.find("peak battery current [A]"), std::string::npos);
  EXPECT_NE(text.find("10.50"), std::string::npos);
  EXPECT_NE(MetricsMarkdown(metrics).find("| `peak_current_A` |"), std::string::npos);
}

TEST(ExampleMetric, IsThatOfThePage) {
  const std::string code =
      core::ReadText(test::SourcePath("tests/analysis/metrics/example_metric.cc"));
  const std::string page = core::ReadText(test::SourcePath("docs/add_a_metric.md"));
  EXPECT_NE(page.find("```cpp\n" + code + "```\n"), std::string::npos);
  EXPECT_LT(std::count(code.begin(), code.end(), '\n'), 30);
}

}  // namespace
}  // namespace scoria::analysis
