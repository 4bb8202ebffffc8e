// SPDX-License-Identifier: BSD-3-Clause
// Bags of rosbag2 and others, held against what an independent reader says that they hold. Their
// messages are decoded in tests/logs/ros/bags_test.cc.
#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "logs/format/open_log.h"
#include "tests/logs/format/log_lines.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class Rosbag2Reference : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("SCORIA_REFERENCE_DATA");
    if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
    folder_ = fs::path(data) / "rosbag2";
    summary_ = json::parse(std::ifstream(folder_ / "expected_summary.json"));
  }
  fs::path folder_;
  json summary_;
};

std::int64_t TimeOf(const json& topic, const char* key) {
  return std::stoll(topic.at(key).get<std::string>());
}

void CompareTopic(const json& expected, const LogChannel& channel) {
  EXPECT_EQ(channel.type_name, expected.at("type"));
  EXPECT_EQ(channel.message_encoding, expected.value("encoding", "cdr"));
  EXPECT_EQ(channel.message_count, expected.at("count"));
  ASSERT_EQ(channel.span.has_value(), expected.at("count") > 0);
  if (channel.span) {
    EXPECT_EQ(*channel.span,
              (LogSpan{TimeOf(expected, "first_log_time"), TimeOf(expected, "last_log_time")}));
  }
  if (expected.contains("schema_encoding")) {
    ASSERT_TRUE(channel.schema.has_value());
    EXPECT_EQ(channel.schema->encoding, expected.at("schema_encoding"));
  }
}

TEST_F(Rosbag2Reference, EveryFileHasItsTopicsCountsAndSpans) {
  EXPECT_GE(summary_.size(), 40u);
  for (const auto& [file, expected] : summary_.items()) {
    SCOPED_TRACE(file);
    const std::unique_ptr<LogSource> log = OpenLog(folder_ / file);
    std::map<std::string, std::uint64_t> read;
    log->ForEach({}, [&](const LogMessage& m) { ++read[m.channel.topic]; });
    const std::vector<LogChannel>& channels = log->contents().channels;
    for (const json& topic : expected.at("topics")) {
      SCOPED_TRACE(topic.at("topic"));
      const auto channel = std::find_if(channels.begin(), channels.end(), [&](const auto& c) {
        return c.topic == topic.at("topic");
      });
      ASSERT_NE(channel, channels.end());
      CompareTopic(topic, *channel);
      EXPECT_EQ(read[channel->topic], topic.at("count"));
    }
    // The other reader leaves out channels of MCAP without messages.
    for (const LogChannel& channel : channels) {
      const bool is_known =
          std::any_of(expected.at("topics").begin(), expected.at("topics").end(),
                      [&](const json& topic) { return topic.at("topic") == channel.topic; });
      EXPECT_TRUE(is_known || channel.message_count == 0u) << channel.topic;
    }
    EXPECT_EQ(ProblemText(log->problems()), "");
  }
}

/// In two bags metadata.yaml has the times of the last file alone, in one another serialisation
/// than the database.
const std::map<fs::path, std::string> kOdd = {
    {"ros2_rosbag2/rosbag2_py/test/resources/mcap/wbag",
     "metadata.yaml: has other times: it begins +0.000 s and ends +0.000 s from the files' "
     "messages"},
    {"ros2_rosbag2/rosbag2_py/test/resources/sqlite3/wbag",
     "metadata.yaml: has other times: it begins +0.000 s and ends +0.000 s from the files' "
     "messages"},
    {"ros2_rosbag2/rosbag2_tests/resources/sqlite3/wrong_rmw_test",
     "metadata.yaml: is wrong about /array_topic (cdr, not wrong_format), /test_topic (cdr, not "
     "wrong_format)"}};

/// All files of a folder together, with or without its metadata.yaml.
TEST_F(Rosbag2Reference, EveryBagHasWhatItsFilesHave) {
  std::map<fs::path, std::map<std::string, std::uint64_t>> bags;
  for (const auto& [file, expected] : summary_.items()) {
    for (const json& topic : expected.at("topics"))
      bags[fs::path(file).parent_path()][topic.at("topic")] +=
          topic.at("count").get<std::uint64_t>();
  }
  int opened = 0;
  for (const auto& [bag, counts] : bags) {
    if (bag.filename() == "bags") continue;  // files side by side that are no bag
    SCOPED_TRACE(bag);
    const std::unique_ptr<LogSource> log = OpenLog(folder_ / bag);
    std::map<std::string, std::uint64_t> read;
    std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
    log->ForEach({}, [&](const LogMessage& m) {
      ++read[m.channel.topic];
      EXPECT_GE(m.log_time_ns, last_ns);
      last_ns = m.log_time_ns;
    });
    for (const auto& [topic, count] : counts) EXPECT_EQ(read[topic], count) << topic;
    EXPECT_FALSE(LosesData(log->problems())) << ProblemText(log->problems());
    const bool is_odd = kOdd.contains(bag);
    EXPECT_EQ(ProblemsOf(*log), is_odd ? Lines{kOdd.at(bag)} : Lines{});
    ++opened;
  }
  EXPECT_GE(opened, 20);
}

TEST_F(Rosbag2Reference, RobotsBagIsReadByItsFolder) {
  const std::unique_ptr<LogSource> log =
      OpenLog(folder_.parent_path() / "logs/go2_vicon_orl/test_6_vicon_bag");
  EXPECT_EQ(CountMessages(*log), 7396u);
  EXPECT_EQ(ProblemsOf(*log), Lines{});
}

}  // namespace
}  // namespace scoria::logs
