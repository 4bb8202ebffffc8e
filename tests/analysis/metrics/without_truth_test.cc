// SPDX-License-Identifier: BSD-3-Clause
// A log from which everything was dropped that only a simulator knows goes through every metric and
// every section of the report.
#include <algorithm>
#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/metric_text.h"
#include "analysis/metrics/metrics.h"
#include "analysis/report/metric_files.h"
#include "analysis/report/plain_text.h"
#include "analysis/report/report.h"
#include "app/run/run_scenario.h"
#include "core/files.h"
#include "logs/read_rows.h"
#include "tests/support/logs.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

bool NeedsTruth(const Metric& metric) {
  for (const auto& [group, name] : EnumNames(logs::RowGroup{})) {
    if (metric.info.needs[static_cast<std::size_t>(group)] && logs::IsTruth(group)) return true;
  }
  return false;
}

EpisodeMetrics MetricsOfLog(const fs::path& log) {
  constexpr double kGravity_mps2 = 9.81;
  MetricsAccumulator accumulator(kGravity_mps2);
  EXPECT_EQ(logs::ForEachRow(log, [&](const logs::Row& row) { accumulator.AddRow(row); }), "");
  return accumulator.Finish();
}

/// The folder's log as a campaign of one, as a log of a robot would come.
ReportInput InputOf(const fs::path& folder) {
  EpisodeRecord e;
  e.id = e.arm = "walk";
  e.end = "completed";
  e.has_metrics = true;
  e.metrics = MetricsOfLog(folder / "log.mcap");
  e.folder = folder;
  CampaignResults results;
  results.name = "walk";
  results.arms = {e.arm};
  results.episodes = {e};
  results.single_run = true;
  return MakeReportInput(folder, results, std::nullopt);
}

/// A short walk that gives most numbers, and the same without the truth.
class WithoutTruth : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::TemporaryFolder>();
    app::RunOptions options;
    options.folder = folder_->path() / "whole";
    const app::Scenario scenario =
        test::LoadScenario("flat", {"duration_s=12", "start=standing", "log.keep=full",
                                    "operator={type: velocity, "
                                    "steps: [{at_s: 0, v_x_mps: 0.4}]}",
                                    "controller.adaptation={type: kf}"});
    (void)app::RunToFolder(scenario, options);
    fs::create_directories(Bare());
    test::CopyLog(Whole() / "log.mcap", Bare() / "log.mcap",
                  [](const std::string& topic) { return !test::IsTruthTopic(topic); });
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path Whole() { return folder_->path() / "whole"; }
  static fs::path Bare() { return folder_->path() / "bare"; }

 private:
  static inline std::unique_ptr<test::TemporaryFolder> folder_;
};

TEST_F(WithoutTruth, EveryMetricThatNeedsItIsAbsentAndSaysWhy) {
  const EpisodeMetrics whole = MetricsOfLog(Whole() / "log.mcap");
  const EpisodeMetrics bare = MetricsOfLog(Bare() / "log.mcap");
  int lost = 0, kept = 0;
  for (const Metric& metric : AllMetrics()) {
    const std::optional<double> value = ValueOf(metric, whole);
    const logs::RowGroups missing = MissingGroups(metric.info.needs, bare.groups);
    if (NeedsTruth(metric)) {
      lost += value ? 1 : 0;
      EXPECT_FALSE(ValueOf(metric, bare)) << metric.info.key;
      EXPECT_TRUE(DescribeMissing(missing).starts_with("the log has no ")) << metric.info.key;
    } else {
      kept += value ? 1 : 0;
      EXPECT_EQ(ValueOf(metric, bare), value) << metric.info.key;
      EXPECT_TRUE(missing.none()) << metric.info.key;
    }
  }
  EXPECT_GE(lost, 30) << "numbers that the whole log gave";
  EXPECT_GE(kept, 6);
}

TEST_F(WithoutTruth, FilesHoldNoNumberThatNeedsIt) {
  WriteMetricFiles(InputOf(Bare()), Bare());
  std::istringstream csv(core::ReadText(Bare() / "metrics.csv"));
  std::string header, line;
  std::getline(csv, header);
  std::getline(csv, line);
  std::istringstream keys(header), fields(line);
  int empty = 0;
  for (std::string key; std::getline(keys, key, ',');) {
    std::string field;
    std::getline(fields, field, ',');
    const Metrics all = AllMetrics();
    const Metric* metric = FindMetric(all, key);
    if (metric == nullptr || !NeedsTruth(*metric)) continue;
    EXPECT_EQ(field, "") << key;
    ++empty;
  }
  EXPECT_GE(empty, 30);
  const nlohmann::json cell =
      nlohmann::json::parse(core::ReadText(Bare() / "metrics.json")).at("cells").at(0);
  const nlohmann::json flat = cell.flatten();
  for (const Metric& metric : AllMetrics()) {
    const std::string end = fmt::format("/{}", metric.info.key);
    for (const auto& [path, value] : flat.items()) {
      if (!NeedsTruth(metric) || !path.ends_with(end)) continue;
      EXPECT_TRUE(value.is_null()) << path;
    }
  }
  EXPECT_TRUE(cell.at("metres").is_null());
}

/// Whether every cell of a column is a dash.
bool IsEmpty(const Table& table, std::size_t column) {
  return std::all_of(table.rows.begin(), table.rows.end(),
                     [&](const auto& row) { return row.at(column) == "–"; });
}

TEST_F(WithoutTruth, SectionsShowNoneOrSayWhy) {
  const Document document = ComposeReport(InputOf(Bare()));
  for (const char* title : {"Falls", "Cost of transport", "Tracking", "Contact detection",
                            "Online model adaptation", "Energy ledger"}) {
    const bool said = std::any_of(
        document.not_shown.begin(), document.not_shown.end(), [&](const std::string& reason) {
          return reason.starts_with(fmt::format("{}, because the log has no true", title)) ||
                 reason.starts_with(fmt::format("{}, because the log has no ledger", title)) ||
                 reason.starts_with(fmt::format("{}, because the log has no truth", title));
        });
    EXPECT_TRUE(said) << title;
  }
  int empty = 0;
  for (const Chapter& chapter : document.chapters) {
    for (const Block& block : chapter.blocks) {
      const auto* table = std::get_if<Table>(&block);
      for (std::size_t i = 0; table != nullptr && i < table->header.size(); ++i) {
        for (const Metric& metric : AllMetrics()) {
          if (!NeedsTruth(metric) || table->header[i] != TitleWithUnit(metric.info)) continue;
          EXPECT_TRUE(IsEmpty(*table, i)) << chapter.key << ": " << table->header[i];
          ++empty;
        }
      }
    }
  }
  EXPECT_GE(empty, 20) << "columns of tables that are shown";
  const std::string text = ToPlainText(document);
  EXPECT_EQ(text.find("not walked"), std::string::npos);
  EXPECT_NE(text.find("Way and falls are not valid here: the log has no truth."),
            std::string::npos);
  EXPECT_NE(text.find("velocity RMSE, "), std::string::npos);
  EXPECT_NE(text.find(": not valid here: the log has no truth"), std::string::npos);
}

// The same numbers as the episode's own result, which knows the rows before they are logged.
TEST_F(WithoutTruth, ResultOfTheEpisodeHoldsEveryMetric) {
  const nlohmann::json scalars =
      nlohmann::json::parse(core::ReadText(Whole() / "result.json")).at("metrics").at("scalars");
  const EpisodeMetrics whole = MetricsOfLog(Whole() / "log.mcap");
  for (const Metric& metric : AllMetrics()) {
    const std::string key(metric.info.key);
    ASSERT_TRUE(scalars.contains(key));
    if (const auto value = ValueOf(metric, whole)) {
      EXPECT_EQ(scalars.at(key), *value) << key;
    }
  }
  EXPECT_TRUE(scalars.at("sensor_distrusted_share").is_number());
  EXPECT_TRUE(scalars.at("standing_drift_m").is_null()) << "it did not stand";
}

TEST_F(WithoutTruth, SummaryOfTheEpisodeSaysWhatIsNotValid) {
  const EpisodeMetrics bare = MetricsOfLog(Bare() / "log.mcap");
  const std::string text = DescribeMetrics(AllMetrics(), bare);
  EXPECT_NE(text.find("NIS / dof "), std::string::npos);
  EXPECT_NE(text.find("MPC median "), std::string::npos);
  EXPECT_EQ(text.find("distance 0"), std::string::npos);
  EXPECT_NE(text.find("falls, falls per metre, stuck, distance, "), std::string::npos) << text;
  EXPECT_NE(text.find("NEES / 5: not valid here: the log has no truth\n"), std::string::npos)
      << text;
}

}  // namespace
}  // namespace scoria::analysis
