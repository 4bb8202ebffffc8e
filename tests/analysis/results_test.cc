// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/results.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/report.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A campaign of one episode per text, each its result.json.
void WriteCampaign(const fs::path& folder, const std::vector<std::string>& results) {
  json index = {{"name", "n"},
                {"arms", {"50 % \"x\"\\y"}},
                {"sweep", json::array()},
                {"episodes", json::array()}};
  for (std::size_t i = 0; i < results.size(); ++i) {
    const std::string id = fmt::format("e{}", i);
    index["episodes"].push_back(
        {{"id", id}, {"arm", "50 % \"x\"\\y"}, {"point", json::array()}, {"seed", i}});
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
    EXPECT_EQ(e.falls, 0);
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
  EXPECT_NE(html.find("log.mcap: not an MCAP file"), std::string::npos);
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
