// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/campaign/campaign.h"
#include "app/episode/run_episode.h"
#include "app/rerun/replay.h"
#include "app/rerun/verify.h"
#include "app/run/log_origin.h"
#include "app/run/run_scenario.h"
#include "core/files.h"
#include "core/robot_files/load.h"
#include "logs/format/cdr.h"
#include "logs/format/mcap_writer.h"
#include "logs/format/open_log.h"
#include "logs/messages/scoria.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

Scenario ShortScenario() {
  return test::LoadScenario("rough", {"terrain.size_m=25.6", "operator.distance_m=2",
                                      "duration_s=8", "terrain.roughness_scale=1.3"});
}

EpisodeReport RunInto(const Scenario& scenario, const fs::path& folder) {
  RunOptions options;
  options.folder = folder;
  return RunToFolder(scenario, options);
}

TEST(Determinism, SameBitsWithAndWithoutLog) {
  const test::TemporaryFolder folder;
  Scenario scenario = ShortScenario();
  const auto full = RunInto(scenario, folder.path() / "full").result.state_hash;
  EXPECT_EQ(RunInto(scenario, folder.path() / "again").result.state_hash, full);
  scenario.log.keep = KeepLog::kMetrics;
  EXPECT_EQ(RunInto(scenario, folder.path() / "metrics").result.state_hash, full);
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  EXPECT_EQ(RunEpisode(scenario, robot, ground).state_hash, full);
  scenario.seed = 2;
  EXPECT_NE(RunInto(scenario, folder.path() / "other").result.state_hash, full);
}

/// Hash of every episode of a campaign folder.
std::map<std::string, std::string> Hashes(const fs::path& folder) {
  std::map<std::string, std::string> hashes;
  for (const auto& entry : fs::directory_iterator(folder / "episodes")) {
    std::ifstream in(entry.path() / "result.json");
    hashes[entry.path().filename().string()] = nlohmann::json::parse(in).at("state_hash");
  }
  return hashes;
}

Campaign SmallCampaign(const fs::path& folder) {
  std::ofstream(folder / "c.yaml")
      << "name: small\nseeds: 2\nscenario:\n  base: "
      << test::SourcePath("scenarios/rough.yaml").string()
      << "\n  terrain: {size_m: 25.6}\n  duration_s: 5\n  log: {keep: falls}\n"
         "arms:\n  - {name: ags, set: {controller: {gait: {type: ags}}}}\n"
         "  - {name: sgs, set: {controller: {gait: {type: sgs}}}}\n";
  return LoadCampaign(folder / "c.yaml", {});
}

TEST(Determinism, OneAndTwoWorkersGiveTheSameBits) {
  const test::TemporaryFolder folder;
  const Campaign campaign = SmallCampaign(folder.path());
  CampaignOptions options;
  options.program = SCORIA_PROGRAM;
  options.folder = folder.path() / "one";
  options.workers = 1;
  EXPECT_EQ(RunCampaign(campaign, options).crashed, 0);
  options.folder = folder.path() / "two";
  options.workers = 2;
  EXPECT_EQ(RunCampaign(campaign, options).crashed, 0);
  const auto hashes = Hashes(folder.path() / "one");
  EXPECT_EQ(hashes.size(), 4u);
  EXPECT_EQ(hashes, Hashes(folder.path() / "two"));
  EXPECT_EQ(RunCampaign(campaign, options).done_before, 4)
      << "a finished campaign is not walked again";
}

TEST(Determinism, MpcOnItsOwnThreadGivesTheSameBits) {
  for (const int latency : {0, 1, 3}) {
    std::vector<std::uint64_t> hashes;
    for (const char* threaded : {"false", "true"}) {
      const Scenario scenario = test::LoadScenario(
          "rough", {fmt::format("controller.mpc.threaded={}", threaded),
                    fmt::format("controller.mpc.latency_ticks={}", latency), "duration_s=4"});
      const core::RobotDescription robot = core::LoadRobot(scenario.robot);
      const terrains::Heightfield ground =
          terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
      hashes.push_back(RunEpisode(scenario, robot, ground).state_hash);
    }
    EXPECT_EQ(hashes[0], hashes[1]) << "latency " << latency;
  }
}

TEST(Campaign, DeadWorkerIsAnOutcomeNotTheEnd) {
  const test::TemporaryFolder folder;
  const Campaign campaign = SmallCampaign(folder.path());
  CampaignOptions options;
  options.program = "/bin/false";
  options.folder = folder.path() / "dead";
  const CampaignOutcome outcome = RunCampaign(campaign, options);
  EXPECT_EQ(outcome.crashed, 4);
  std::ifstream in(options.folder / "episodes" / "ags-s1" / "result.json");
  EXPECT_EQ(nlohmann::json::parse(in).at("end"), "crashed");
}

TEST(Verify, ProvesALogAndNamesTheFirstDifference) {
  const test::TemporaryFolder folder;
  (void)RunInto(ShortScenario(), folder.path());
  const fs::path log = folder.path() / "log.mcap", altered = folder.path() / "altered.mcap";
  const VerifyResult good = VerifyLog(log);
  EXPECT_TRUE(good.identical) << good.difference;
  EXPECT_GT(good.messages, 1000u);

  // The same log with one number of one message changed.
  {
    logs::McapWriter writer(altered);
    const std::unique_ptr<logs::LogSource> source = logs::OpenLog(log);
    writer.AddMetadata(kScenarioMetadata, source->contents().metadata.at(kScenarioMetadata));
    std::map<std::string, std::uint16_t> channels;
    source->ForEach({}, [&](const logs::LogMessage& m) {
      if (!channels.contains(m.channel.topic)) {
        channels[m.channel.topic] =
            writer.AddChannel(m.channel.topic, m.channel.type_name, m.channel.schema->text);
      }
      logs::Bytes bytes(m.data.begin(), m.data.end());
      if (m.channel.topic == "/joint_states" && m.log_time_ns == 1'500'000'000) {
        auto joints = logs::DecodeCdr<logs::msg::JointState>(bytes);
        joints.velocity[7] += 1e-9;
        logs::EncodeCdr(joints, bytes);
      }
      writer.Write(channels[m.channel.topic], m.log_time_ns, bytes);
    });
  }
  const VerifyResult bad = VerifyLog(altered);
  EXPECT_FALSE(bad.identical);
  EXPECT_EQ(bad.difference.find("step 1500 (1.500 s): /joint_states: velocity[7]: the log says "),
            0u)
      << bad.difference;
}

TEST(Verify, RerunsInTheEngineOfTheLog) {
  const test::TemporaryFolder folder;
  Scenario scenario = ShortScenario();
  scenario.physics.engine = sim::BulletDynamics{};
  (void)RunInto(scenario, folder.path());
  const fs::path log = folder.path() / "log.mcap";
  const VerifyResult r = VerifyLog(log);
  EXPECT_TRUE(r.identical) << r.difference;
  EXPECT_GT(r.messages, 1000u);
  EXPECT_EQ(logs::OpenLog(log)->contents().metadata.at(kScenarioMetadata).at("engine"), "bullet");
  std::ifstream result(folder.path() / "result.json");
  EXPECT_EQ(nlohmann::json::parse(result).at("engine"), "bullet");
}

TEST(Verify, TruncatedLogIsComparedAsFarAsItGoes) {
  const test::TemporaryFolder folder;
  (void)RunInto(ShortScenario(), folder.path());
  const fs::path log = folder.path() / "log.mcap";
  fs::resize_file(log, fs::file_size(log) * 6 / 10);
  const VerifyResult r = VerifyLog(log);
  EXPECT_TRUE(r.identical) << r.difference;
  EXPECT_NE(r.file_problem.find("cut off at byte"), std::string::npos);
}

TEST(Verify, InterruptedRunIsProvedUpToItsEnd) {
  const test::TemporaryFolder folder;
  for (const double stop_s : {0.0, 0.25, 1.0}) {
    std::atomic<bool> stop = false;
    RunOptions options;
    options.folder = folder.path();
    options.interrupted = &stop;
    options.on_progress = [&](double time_s, int) { stop = time_s >= stop_s; };
    ASSERT_EQ(RunToFolder(ShortScenario(), options).result.end, EpisodeEnd::kInterrupted);
    const VerifyResult r = VerifyLog(folder.path() / "log.mcap");
    EXPECT_TRUE(r.identical) << r.difference;
    EXPECT_FALSE(r.complete);
    EXPECT_NEAR(r.until_s, stop_s + ShortScenario().physics.step_s, 1e-6) << "that was not run";
  }
}

TEST(Verify, RunInterruptedBeforeItsFirstStepHasNothingToDiffer) {
  const test::TemporaryFolder folder;
  const std::atomic<bool> stop = true;
  RunOptions options;
  options.folder = folder.path();
  options.interrupted = &stop;
  (void)RunToFolder(ShortScenario(), options);
  const VerifyResult r = VerifyLog(folder.path() / "log.mcap");
  EXPECT_TRUE(r.identical) << r.difference;
  EXPECT_EQ(r.messages, 0u);
  EXPECT_EQ(r.until_s, 0.0);
  try {
    (void)ReplayLog(folder.path() / "log.mcap", {});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_STREQ(e.what(), "the log ends before the first controller input");
  }
}

TEST(Verify, LogCutBeforeItsFirstChunkSaysSo) {
  const test::TemporaryFolder folder;
  (void)RunInto(ShortScenario(), folder.path());
  const fs::path log = folder.path() / "log.mcap";
  const std::string bytes = core::ReadText(log);
  fs::resize_file(log, bytes.find("zstd"));
  const VerifyResult r = VerifyLog(log);
  EXPECT_FALSE(r.identical);
  EXPECT_EQ(r.difference, "the log ends before a whole step that could be compared");
  try {
    (void)ReplayLog(log, {});
    FAIL();
  } catch (const std::runtime_error& e) {
    const std::string what = e.what();
    EXPECT_NE(what.find("cut off at byte"), std::string::npos) << what;
    EXPECT_NE(what.find("; there are no controller inputs before that"), std::string::npos) << what;
    EXPECT_EQ(what.find("log.keep=full"), std::string::npos) << what;
  }
}

}  // namespace
}  // namespace scoria::app
