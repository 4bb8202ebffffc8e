// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/results.h"

#include <cstdlib>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/report/report.h"
#include "analysis/terrain/terrain_view.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A campaign of one episode per text, each its result.json. The arms take turns.
void WriteCampaign(const fs::path& folder, const std::vector<std::string>& results,
                   const std::vector<std::string>& arms = {"a"}) {
  json index = {
      {"name", arms[0]}, {"arms", arms}, {"sweep", json::array()}, {"episodes", json::array()}};
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::string id = fmt::format("e{}", i);
    index["episodes"].push_back(
        {{"id", id}, {"arm", arms[i % arms.size()]}, {"point", json::array()}, {"seed", i}});
    core::CreateFolders(folder / "episodes" / id);
    core::WriteText(folder / "episodes" / id / "result.json", results[i]);
  }
  core::WriteText(folder / "campaign.json", index.dump());
}

TEST(Results, BrokenOnesAreCrashedEpisodesWithTheirReason) {
  const test::TemporaryFolder folder;
  const std::vector<std::string> broken = {"",
                                           "{",
                                           "[]",
                                           "null",
                                           R"({"end": 1})",
                                           R"({"end": "completed", "metrics": {}})",
                                           R"({"end": "completed", "falls": "x", "metrics": 3})",
                                           "\xff\xfe",
                                           std::string(300, '['),
                                           "{\"end\": \"comple"};
  WriteCampaign(folder.path(), broken);
  const CampaignResults results = LoadResults(folder.path());
  ASSERT_EQ(results.episodes.size(), broken.size());
  for (const EpisodeRecord& e : results.episodes) {
    EXPECT_EQ(e.end, "crashed") << e.id;
    EXPECT_EQ(e.message.find("result.json cannot be read: "), 0u) << e.message;
    EXPECT_FALSE(e.has_metrics);
    EXPECT_FALSE(e.metrics.outcome);
  }
  const std::string html = core::ReadText(WriteReport(folder.path()));
  EXPECT_NE(html.find("<td>e0</td><td>crashed</td><td>result.json cannot be read: "),
            std::string::npos);
}

TEST(Results, NumbersThatAreNoneKeepTheEnd) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), {R"({"end": "non_finite", "message": "m", "metrics": null})"});
  const CampaignResults results = LoadResults(folder.path());
  EXPECT_EQ(results.episodes[0].end, "non_finite");
  EXPECT_EQ(results.episodes[0].message.find("m; result.json cannot be read: "), 0u)
      << results.episodes[0].message;
}

TEST(Results, BrokenSingleRunIsAReportOfACrash) {
  const test::TemporaryFolder folder;
  core::WriteText(folder.path() / "result.json", "{");
  core::WriteText(folder.path() / "log.mcap", "no log");
  const std::string html = core::ReadText(WriteReport(folder.path()));
  EXPECT_NE(html.find("<td>crashed</td>"), std::string::npos);
  EXPECT_NE(html.find("log.mcap: is not a log that scoria reads"), std::string::npos);
}

/// A result that a report draws.
std::string WholeResult() {
  EpisodeMetrics m;
  m.distance_m = 50.0;
  m.mass_kg = 15.0;
  m.mpc = m.wbc = {1e-4, 2e-4, 3e-4, 1000};
  for (int k = 0; k < 10; ++k) m.windows.push_back({0.3 + 0.002 * k, 0.3, 0.5, 0.3, 2.0});
  m.falls.push_back({1.0, "tilt at x 0 m"});
  const json terrain = ToJson(terrains::TerrainStatistics{.materials = {{"tuff", 1.0}}});
  return json{{"end", "completed"},
              {"falls", 1},
              {"stuck", 0},
              {"walked_m", 50.0},
              {"counters", json::object()},
              {"real_time_factor", 9.0},
              {"terrain", terrain},
              {"metrics", m}}
      .dump();
}

TEST(Report, HoldsAnyName) {
  const std::vector<std::string> names = {
      "50 % \"x\"\\y", "duty 50%", "100 %s",      "back\\slash",
      "<b>&amp;",      "$(x)",     "`x`",         "a_b^c{d}@e~f",
      "it's",          "a/b",      ".hidden",     "Rückweg 歩行",
      "two\nlines",    "\x01",     "w\" onload=", std::string(2000, 'w')};
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), std::vector<std::string>(names.size(), WholeResult()), names);
  const std::string html = core::ReadText(WriteReport(folder.path()));
  EXPECT_EQ(html.find("could not be drawn"), std::string::npos);
  EXPECT_EQ(html.find("cannot be read"), std::string::npos);
  for (const char* seen : {"<td>50 % &quot;x&quot;\\y</td>", "<td>duty 50%</td>", "<td>`x`</td>",
                           "<td>&lt;b&gt;&amp;amp;</td>", "<td>Rückweg 歩行</td>"})
    EXPECT_NE(html.find(seen), std::string::npos) << seen;
  EXPECT_EQ(html.find("<b>"), std::string::npos);
}

TEST(Report, WithoutGnuplotHoldsSentencesForFigures) {
  const test::TemporaryFolder folder;
  WriteCampaign(folder.path(), {WholeResult()});
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const fs::path page = WriteReport(folder.path());
  setenv("PATH", path.c_str(), 1);
  const std::string html = core::ReadText(page);
  EXPECT_NE(html.find("<p>Solve times: this figure could not be drawn: "), std::string::npos);
  EXPECT_NE(html.find("gnuplot: not found"), std::string::npos);
  EXPECT_NE(html.find(">Numbers</h2>"), std::string::npos);
}

TEST(Results, BrokenIndexSaysTheWayOut) {
  const test::TemporaryFolder folder;
  const fs::path index = folder.path() / "campaign.json";
  for (const char* broken : {"", "{}", "[]", R"({"name": 1})"}) {
    core::WriteText(index, broken);
    try {
      (void)LoadResults(folder.path());
      FAIL() << broken;
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(
          std::string(e.what()).find(
              index.string() + ": cannot be read; the same campaign command writes it anew ("),
          0u)
          << e.what();
    }
  }
}

}  // namespace
}  // namespace scoria::analysis
