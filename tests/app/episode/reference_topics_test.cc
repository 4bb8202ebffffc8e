// SPDX-License-Identifier: BSD-3-Clause
// Logs in the reference framework's topics, as its recorder would leave them.
#include <map>
#include <set>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/episode/record.h"
#include "app/episode/run_episode.h"
#include "app/rerun/verify.h"
#include "app/run/run_scenario.h"
#include "core/files.h"
#include "core/robot_files/load.h"
#include "logs/format/open_log.h"
#include "logs/read_rows.h"
#include "logs/ros/check_message.h"
#include "logs/ros/type_resolver.h"
#include "logs/survey.h"
#include "terrains/generator.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"

namespace scoria::app {
namespace {

/// The definition of a type that is built in, not the log's own.
logs::MessageType BuiltIn(const std::string& type) {
  const logs::TypeChoice choice = logs::TypeResolver().Resolve({type, "cdr", "", ""});
  EXPECT_NE(choice.taken(), nullptr) << type;
  return choice.taken()->type;
}

bool IsOurs(const Topic& topic) { return topic.type_name.starts_with("scoria_msgs/"); }

TEST(ReferenceTopics, HaveTheLayoutsOfTheReferencesDefinitions) {
  int compared = 0;
  for (const Topic& topic : RecordedTopics()) {
    if (IsOurs(topic)) continue;
    const logs::TypeChoice own =
        logs::TypeResolver().Resolve({topic.type_name, "cdr", "ros2msg", topic.schema_text});
    ASSERT_NE(own.taken(), nullptr) << topic.name << own.Report();
    EXPECT_EQ(own.taken()->origin, "the bag");
    EXPECT_EQ(own.taken()->type, BuiltIn(topic.type_name)) << topic.name;
    ++compared;
  }
  EXPECT_EQ(compared, 13);
}

/// Holds every message of the reference's topics against the built-in definition.
class BuiltInChecker final : public MessageSink {
 public:
  void Write(const Topic& topic, std::int64_t, std::span<const std::byte> message) override {
    if (IsOurs(topic)) return;
    if (!types_.contains(topic.name)) types_.emplace(topic.name, BuiltIn(topic.type_name));
    EXPECT_NO_THROW(logs::CheckMessage(types_.at(topic.name), message)) << topic.name;
  }
  void MarkFall(std::int64_t) override {}
  [[nodiscard]] std::size_t topics() const { return types_.size(); }

 private:
  std::map<std::string, logs::MessageType> types_;
};

TEST(ReferenceTopics, AreDecodedByTheReferencesDefinitionsToTheLastByte) {
  const Scenario scenario = test::LoadScenario(
      "flat", {"duration_s=2", "start=standing", "controller.adaptation.type=kf_plus"});
  BuiltInChecker checker;
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  Recorder recorder(checker, scenario);
  (void)RunEpisode(scenario, robot, terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0),
                   {&recorder});
  EXPECT_EQ(checker.topics(), 13u);
}

/// Walks a moment; its log has the reference's topics alone.
class ReferenceLog : public testing::Test {
 protected:
  void SetUp() override {
    RunOptions options;
    options.folder = folder_.path();
    report_ = RunToFolder(LoadWith("reference"), options);
  }
  static Scenario LoadWith(const std::string& topics) {
    return test::LoadScenario("flat", {"duration_s=3", "start=standing", "log.topics=" + topics,
                                       "controller.adaptation.type=kf_plus"});
  }
  [[nodiscard]] std::filesystem::path log() const { return folder_.path() / "log.mcap"; }

  test::TemporaryFolder folder_;
  EpisodeReport report_;
};

TEST_F(ReferenceLog, HoldsWhatTheReferencesRecorderWrites) {
  std::set<std::string> topics;
  const auto source = logs::OpenLog(log());
  for (const logs::LogChannel& channel : source->contents().channels) topics.insert(channel.topic);
  EXPECT_EQ(topics, (std::set<std::string>{
                        "/battery_state", "/contact_state", "/gait_state", "/imu_measurement",
                        "/joint_cmd", "/joint_states", "/quad_control_target", "/quad_model_update",
                        "/quad_state", "/solve_time", "/wbc_solve_time", "/wbc_target"}));
  EXPECT_FALSE(source->contents().metadata.contains(logs::kRowMetadata));
}

TEST_F(ReferenceLog, IsOfTheSameWalk) {
  const test::TemporaryFolder other;
  RunOptions options;
  options.folder = other.path();
  EXPECT_EQ(RunToFolder(LoadWith("all"), options).result.state_hash, report_.result.state_hash);
}

TEST_F(ReferenceLog, IsVerifiedByItsTopics) {
  const VerifyResult result = VerifyLog(log());
  EXPECT_TRUE(result.identical) << result.difference;
  EXPECT_GT(result.messages, 3000u);
  EXPECT_EQ(result.missing, "the log holds the reference's topics alone (log.topics=reference)");
  const test::ProgramEnd end = test::RunScoria({"verify", log().string()});
  EXPECT_EQ(end.output,
            fmt::format("the log holds the reference's topics alone (log.topics=reference); state "
                        "hashes and rows are not compared\nidentical: {} messages\n",
                        result.messages));
}

TEST_F(ReferenceLog, SaysWhatItLacks) {
  const auto output = [&](std::vector<std::string> command) {
    command.insert(command.begin() + 1, "log.mcap");
    const test::ProgramEnd end = test::RunScoria(command, {.folder = folder_.path()});
    EXPECT_EQ(end.code, 2) << command[0];
    return end.output;
  };
  EXPECT_EQ(output({"replay", "--set", "controller.estimator.type=inekf"}),
            "log.mcap: the log holds the reference's topics alone (log.topics=reference), without "
            "the controller's inputs that a replay needs; record it with log.topics=all\n");
  EXPECT_EQ(output({"render"}),
            "log.mcap: the log holds the reference's topics alone (log.topics=reference), without "
            "the rows that a video needs; record it with log.topics=all\n");
  EXPECT_EQ(logs::ReadLog(log()).problem,
            log().string() + ": holds no rows; logs of scoria do, with log.topics=all");
  EXPECT_EQ(test::RunScoria({"report", folder_.path().string()}).code, 0);
  EXPECT_NE(core::ReadText(folder_.path() / "report/report.txt")
                .find("holds no rows; logs of scoria do, with log.topics=all"),
            std::string::npos);
}

// The repository's sample, as scenarios/sample_log.yaml makes it.
TEST(SampleLog, IsReadableByTheReferencesDefinitions) {
  const auto source = logs::OpenLog(test::SourcePath("samples/go2_walk.mcap"));
  EXPECT_LT(std::filesystem::file_size(source->contents().path), 1'000'000u);
  const logs::LogSurvey survey = logs::SurveyLog(*source, logs::TypeResolver());
  EXPECT_TRUE(source->problems().empty()) << logs::ProblemText(source->problems());
  ASSERT_EQ(survey.channels.size(), 12u);
  for (std::size_t i = 0; i < survey.channels.size(); ++i) {
    const logs::LogChannel& channel = source->contents().channels[i];
    EXPECT_GT(survey.channels[i].messages, 0u) << channel.topic;
    EXPECT_EQ(survey.channels[i].undecoded, 0u) << channel.topic;
    EXPECT_EQ(survey.channels[i].type.taken()->type, BuiltIn(channel.type_name)) << channel.topic;
  }
}

}  // namespace
}  // namespace scoria::app
