// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/sections.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "analysis/report/report.h"
#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::analysis {
namespace {

EpisodeRecord Walked(const std::string& arm, std::uint64_t seed) {
  EpisodeRecord e;
  e.id = e.arm = arm;
  e.seed = seed;
  e.ground = std::to_string(seed);
  e.end = "completed";
  e.has_metrics = true;
  e.metrics.outcome = {.falls = 0, .stuck = 0, .real_time_factor = 1.0};
  e.metrics.distance_m = 50.0;
  return e;
}

/// A run on the true state that did nothing remarkable.
CampaignResults PlainRun() {
  CampaignResults results;
  results.name = "run";
  results.arms = {"run"};
  results.single_run = true;
  results.episodes = {Walked("run", 1)};
  return results;
}

Document Compose(CampaignResults results, const std::filesystem::path& folder) {
  for (EpisodeRecord& e : results.episodes) e.folder = folder;
  return ComposeReport(MakeReportInput(folder, std::move(results), std::nullopt));
}

const Chapter* Find(const Document& document, const std::string& key) {
  const auto found = std::find_if(document.chapters.begin(), document.chapters.end(),
                                  [&](const Chapter& c) { return c.key == key; });
  return found == document.chapters.end() ? nullptr : &*found;
}

bool Says(const Document& document, const std::string& reason) {
  return std::find(document.not_shown.begin(), document.not_shown.end(), reason) !=
         document.not_shown.end();
}

TEST(Sections, HaveKeysOfTheirOwn) {
  std::set<std::string> keys, titles;
  for (const Section& s : AllSections()) {
    EXPECT_TRUE(keys.insert(s.key).second) << s.key;
    EXPECT_TRUE(titles.insert(s.title).second) << s.title;
    EXPECT_EQ(core::FileNameOf(s.key), s.key) << "an anchor";
  }
}

TEST(Sections, AreShownOrSayWhyNot) {
  const test::TemporaryFolder folder;
  CampaignResults nothing;
  nothing.arms = {"a", "b"};
  CampaignResults broken = PlainRun();
  broken.episodes[0].has_metrics = false;
  for (const CampaignResults& results : {nothing, broken, PlainRun()}) {
    const Document d = Compose(results, folder.path());
    EXPECT_EQ(d.chapters.size() + d.not_shown.size(), AllSections().size());
    for (const Chapter& c : d.chapters) EXPECT_FALSE(c.blocks.empty()) << c.key;
  }
}

TEST(Sections, PlainRunSaysWhatItDoesNotShow) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(Compose(PlainRun(), folder.path()).not_shown,
            (std::vector<std::string>{
                "Who falls less, at each point, because there is one arm, and none to compare it "
                "with.",
                "Rate ratios and power, because there is one arm, and none to compare it with.",
                "The same in both engines?, because the physics engine was not swept.",
                "Metres to the first fall, because no episode fell whose way to the first fall is "
                "known.",
                "Response over the factors, because the sweep is no design over factors.",
                "Falls, because no episode fell, and no number was swept that falls could be drawn "
                "against.",
                "Cost of transport, because no episode walked steadily for five seconds.",
                "Tracking, because no episode walked steadily.",
                "Differences between the arms, because there is one arm, and none to compare it "
                "with.",
                "State estimation, because every episode walked on the true state.",
                "Contact detection, because no source of contact but the truth was used.",
                "Online model adaptation, because no arm adapted its model.",
                "Bias budget, because no sweep names a baseline.",
                "Tracking with and without adaptation, because no arm adapted its model.",
                "Energy ledger, because no episode left numbers of the motors' work.",
                "Ground, as measured on its grids, because no episode left numbers of its ground.",
                "Course of single episodes, because the run kept no log.",
                "Videos, because there is none in the folder."}));
}

TEST(Sections, CrashedEpisodesLeaveNoNumbers) {
  const test::TemporaryFolder folder;
  CampaignResults results = PlainRun();
  results.episodes[0].has_metrics = false;
  results.episodes[0].end = "crashed";
  const Document d = Compose(results, folder.path());
  for (const char* title :
       {"State estimation", "Contact detection", "Online model adaptation", "Computing time"}) {
    EXPECT_TRUE(Says(d, std::string(title) + ", because no episode left numbers.")) << title;
  }
  ASSERT_NE(Find(d, "failures"), nullptr);
  EXPECT_EQ(std::get<Table>(Find(d, "failures")->blocks[0]).rows[0][1], "crashed");
}

TEST(Sections, VerdictsAtPointsNeedASweep) {
  const test::TemporaryFolder folder;
  CampaignResults results = PlainRun();
  results.single_run = false;
  results.arms = {"a", "b"};
  results.episodes = {Walked("a", 1), Walked("b", 1)};
  const Document d = Compose(results, folder.path());
  EXPECT_TRUE(Says(d, "Who falls less, at each point, because the arms walked no sweep."));
  ASSERT_EQ(d.head.below.size(), 1u) << "how to read the verdict of the head";
  results.axes = {{"x", "x", {"low", "high"}, ""}};
  results.episodes[0].point = results.episodes[1].point = {"low"};
  const Document swept = Compose(results, folder.path());
  EXPECT_TRUE(swept.head.below.empty());
  ASSERT_NE(Find(swept, "point_verdicts"), nullptr);
  EXPECT_EQ(std::get<BulletList>(Find(swept, "point_verdicts")->blocks[0]).items.size(), 2u);
  EXPECT_TRUE(Says(swept,
                   "Falls, because no episode fell, and no number was swept that falls could be "
                   "drawn against."));
}

TEST(Sections, GroundThatCannotBeMadeAgainIsASentence) {
  const test::TemporaryFolder folder;
  CampaignResults results = PlainRun();
  results.episodes[0].metrics.outcome->falls = 1;
  results.episodes[0].metrics.falls = {{1.0, "tilt", Vec2(0.0, 0.0)}};
  core::WriteText(folder.path() / "scenario.yaml", "seed: 1\n");
  const Document d = Compose(results, folder.path());
  ASSERT_NE(Find(d, "falls"), nullptr);
  EXPECT_EQ(std::get<Paragraph>(Find(d, "falls")->blocks[0]).text,
            "Falls on the ground of seed 1: this map could not be drawn: scenario.yaml names no "
            "terrain or no seed");
  EXPECT_TRUE(Says(d, "Course of single episodes, because the run kept no log."));
  results.episodes[0].metrics.falls[0].p_WB.reset();
  EXPECT_TRUE(Says(Compose(results, folder.path()),
                   "Falls, because the results do not say where the falls were, and no number was "
                   "swept that falls could be drawn against."));
}

/// Of a log that is damaged there is the problem, in words.
TEST(Sections, CourseHoldsWhatIsWrongWithALog) {
  const test::TemporaryFolder folder;
  core::WriteText(folder.path() / "log.mcap", "no log");
  const Document d = Compose(PlainRun(), folder.path());
  ASSERT_NE(Find(d, "course"), nullptr);
  EXPECT_NE(std::get<Note>(Find(d, "course")->blocks[0]).text.find("not a log"), std::string::npos);
}

TEST(Sections, FailuresEndWithWhatWasMetWithoutFalling) {
  const test::TemporaryFolder folder;
  CampaignResults results = PlainRun();
  results.episodes[0].counters = {{"late_contact", 3}, {"mpc_failure", 0}};
  const Document d = Compose(results, folder.path());
  ASSERT_NE(Find(d, "failures"), nullptr);
  const Blocks& blocks = Find(d, "failures")->blocks;
  EXPECT_EQ(std::get<Paragraph>(blocks.at(1)).text,
            "Stuck 0 times. What the controller met and how it fell back:");
  EXPECT_EQ(std::get<Table>(blocks.at(2)).rows,
            (std::vector<std::vector<std::string>>{{"late_contact", "3"}}));
}

TEST(Sections, WhatIsNotMeasuredIsADash) {
  const test::TemporaryFolder folder;
  const Document d = Compose(PlainRun(), folder.path());
  ASSERT_NE(Find(d, "numbers"), nullptr);
  const auto at = [&](const std::string& title) -> std::string {
    for (const Block& block : Find(d, "numbers")->blocks) {
      const auto& t = std::get<Table>(block);
      const auto column = std::find(t.header.begin(), t.header.end(), title);
      if (column != t.header.end())
        return t.rows.at(0).at(static_cast<std::size_t>(column - t.header.begin()));
    }
    return "no such column";
  };
  EXPECT_EQ(at("distance [m]"), "50.0");
  EXPECT_EQ(at("CoT mech_abs"), "–");
  EXPECT_EQ(at("roll RMSE [deg]"), "–");
  EXPECT_EQ(at("MPC p99 [µs]"), "–");
}

TEST(Sections, AdaptationNeedsAnArmWithoutIt) {
  const test::TemporaryFolder folder;
  CampaignResults results = PlainRun();
  results.episodes[0].metrics.model.present = true;
  const Document d = Compose(results, folder.path());
  EXPECT_TRUE(
      Says(d, "Online model adaptation, because no stretch of constant mass was long enough."));
  const std::string section = "Tracking with and without adaptation, because ";
  EXPECT_TRUE(Says(d, section + "every arm adapted its model."));
  results.arms = {"run", "other"};
  results.episodes.push_back(Walked("other", 2));
  EXPECT_TRUE(Says(Compose(results, folder.path()),
                   section + "no seed was walked steadily both with and without adaptation."));
}

}  // namespace
}  // namespace scoria::analysis
