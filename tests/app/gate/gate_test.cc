// SPDX-License-Identifier: BSD-3-Clause
// The gate by the command as users have it, against a baseline of short walks on level ground.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/cli/exit_codes.h"
#include "core/files.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kSeeds = 12;

/// A baseline that all tests share.
class Gate : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    temporary_ = std::make_unique<test::TemporaryFolder>();
    core::WriteText(Folder() / "c.yaml",
                    fmt::format("name: short\nseeds: {}\nscenario:\n  base: {}\n"
                                "  start: standing\n  duration_s: 6\n"
                                "  terrain: {{size_m: 6.4, resolution_m: 0.1}}\n"
                                "  log: {{keep: metrics}}\narms: [{{name: ags}}]\n",
                                kSeeds, test::SourcePath("scenarios/flat.yaml").string()));
    const test::ProgramEnd end = test::RunScoria(
        {"campaign", (Folder() / "c.yaml").string(), "--out", (Folder() / "baseline").string()},
        {.folder = {}, .largest_file = 0, .patience_s = 300});
    ASSERT_EQ(end.code, kOk) << end.output;
  }
  static void TearDownTestSuite() { temporary_.reset(); }
  static fs::path Folder() { return temporary_->path(); }

  struct Ended {
    test::ProgramEnd end;
    json verdict;
  };
  static Ended Run(std::vector<std::string> more,
                   const fs::path& baseline = Folder() / "baseline") {
    const fs::path out = Folder() / fmt::format("gate{}", ++runs_);
    std::vector<std::string> arguments = {"gate",
                                          "--baseline",
                                          baseline.string(),
                                          "--out",
                                          out.string(),
                                          "--json",
                                          (Folder() / "v.json").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Ended ended{test::RunScoria(arguments, {.folder = {}, .largest_file = 0, .patience_s = 300}),
                {}};
    ended.verdict = json::parse(core::ReadText(Folder() / "v.json"), nullptr, false);
    return ended;
  }

 private:
  static std::unique_ptr<test::TemporaryFolder> temporary_;
  static int runs_;
};
std::unique_ptr<test::TemporaryFolder> Gate::temporary_;
int Gate::runs_ = 0;

TEST_F(Gate, EqualBitsEndItAtOnce) {
  const Ended gate = Run({});
  EXPECT_EQ(gate.end.code, kOk) << gate.end.output;
  EXPECT_EQ(gate.verdict["verdict"], "equal");
  EXPECT_EQ(gate.verdict["episodes"], 2) << "one for each worker";
}

TEST_F(Gate, AnotherProcessorSkipsTheComparisonOfBits) {
  const fs::path copy = Folder() / "elsewhere";
  fs::copy(Folder() / "baseline", copy, fs::copy_options::recursive);
  json index = json::parse(core::ReadText(copy / "campaign.json"));
  index["cpu"] = "Z80";
  core::WriteText(copy / "campaign.json", index.dump());
  const Ended gate = Run({"--seeds", "2"}, copy);
  EXPECT_EQ(gate.end.code, kOk);
  EXPECT_NE(gate.end.output.find("another processor (Z80; this is "), std::string::npos)
      << gate.end.output;
  EXPECT_EQ(gate.verdict["verdict"], "no_evidence");
  EXPECT_EQ(gate.verdict["seeds"], 2);
}

TEST_F(Gate, AWrongMassIsWorse) {
  const Ended gate = Run({"--set", "scenario.controller.model.mass_offset_kg=4"});
  EXPECT_EQ(gate.end.code, kFailed) << gate.end.output;
  EXPECT_EQ(gate.verdict["verdict"], "worse");
  EXPECT_LT(gate.verdict["seeds"], kSeeds);
  EXPECT_LE(gate.verdict["p_value"], 0.01);
  EXPECT_NE(gate.end.output.find("worse than the baseline after"), std::string::npos);
}

TEST_F(Gate, OtherBitsOfTheSameQualityPass) {
  const Ended gate = Run({"--set", "scenario.controller.wbc={type: tsid, formulation: full}"});
  EXPECT_EQ(gate.end.code, kOk) << gate.end.output;
  EXPECT_EQ(gate.verdict["verdict"], "no_evidence");
  EXPECT_EQ(gate.verdict["seeds"], kSeeds);
}

TEST_F(Gate, AnEpisodeThatNoLongerWalksIsBroken) {
  const Ended gate =
      Run({"--set", "scenario.start=lying", "--set", "scenario.controller.stand_up.duration_s=20"});
  EXPECT_EQ(gate.end.code, kFailed) << gate.end.output;
  EXPECT_EQ(gate.verdict["verdict"], "broken");
}

// As of a campaign that a cluster walked.
TEST_F(Gate, JudgesWhatHasBeenWalkedElsewhere) {
  const fs::path walked = Folder() / "walked";
  const auto walk = [&](const std::string& set) {
    const test::ProgramEnd end =
        test::RunScoria({"campaign", (Folder() / "c.yaml").string(), "--set", "seeds=6", "--set",
                         set, "--out", walked.string()},
                        {.folder = {}, .largest_file = 0, .patience_s = 300});
    ASSERT_EQ(end.code, kOk) << end.output;
  };
  walk("scenario.controller.model.mass_offset_kg=4");
  const Ended worse = Run({"--walked", walked.string()});
  EXPECT_EQ(worse.end.code, kFailed) << worse.end.output;
  EXPECT_EQ(worse.verdict["verdict"], "worse");
  EXPECT_EQ(worse.verdict["seeds"], worse.verdict["episodes"]);
  walk("scenario.controller.wbc={type: tsid, formulation: full}");
  const Ended same = Run({"--walked", walked.string()});
  EXPECT_EQ(same.end.code, kOk) << same.end.output;
  EXPECT_EQ(same.verdict["seeds"], 6) << "those that both have";
  walk("scenario.name=other");
  EXPECT_EQ(Run({"--walked", walked.string()}).verdict["verdict"], "equal");
}

TEST_F(Gate, TheProgramOfTheBaselineWalksFurtherSeeds) {
  const Ended gate =
      Run({"--set", "scenario.controller.wbc={type: tsid, formulation: full}", "--seeds",
           fmt::format("{}", kSeeds + 2), "--baseline-program", SCORIA_PROGRAM});
  EXPECT_EQ(gate.end.code, kOk) << gate.end.output;
  EXPECT_EQ(gate.verdict["seeds"], kSeeds + 2);
}

TEST_F(Gate, RefusesWhatIsNoBaselineOrAnotherDesign) {
  const fs::path run = Folder() / "run";
  core::CreateFolders(run);
  EXPECT_EQ(Run({}, run).end.code, kBadInput);
  const Ended gate = Run({"--set", "arms=[{name: other}]"});
  EXPECT_EQ(gate.end.code, kBadInput);
  EXPECT_NE(gate.end.output.find("has other arms or another sweep than the baseline"),
            std::string::npos)
      << gate.end.output;
}

}  // namespace
}  // namespace scoria::app
