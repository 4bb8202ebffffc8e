// SPDX-License-Identifier: BSD-3-Clause
// Bags of other software, held against what an independent reader made of them.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "logs/format/open_log.h"
#include "logs/ros/field_reader.h"
#include "logs/ros/type_resolver.h"
#include "logs/ros/visit_leaves.h"
#include "tests/logs/ros/types.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::optional<fs::path> ReferenceData() {
  const char* data = std::getenv("SCORIA_REFERENCE_DATA");
  if (data == nullptr) return std::nullopt;
  return fs::path(data);
}

struct Topic {
  ChannelSchema schema;
  std::vector<Bytes> messages;
};
using Topics = std::map<std::string, Topic>;

/// All messages of a small bag.
Topics ReadBag(const fs::path& file) {
  Topics topics;
  OpenLog(file)->ForEach({}, [&](const LogMessage& m) {
    Topic& topic = topics[m.channel.topic];
    const LogSchema schema = m.channel.schema.value_or(LogSchema{});
    topic.schema = {m.channel.type_name, m.channel.message_encoding, schema.encoding, schema.text};
    topic.messages.emplace_back(m.data.begin(), m.data.end());
  });
  return topics;
}

void ExpectSame(const json& expected, const FieldView& view, std::size_t i,
                const std::string& path) {
  if (expected.is_boolean()) {
    EXPECT_EQ(view.Int(i) != 0, expected.get<bool>()) << path;
  } else if (expected.is_number()) {
    EXPECT_EQ(view.Double(i), expected.get<double>()) << path;
  } else if (IsText(view.type())) {
    EXPECT_EQ(view.Format(i), expected.get<std::string>()) << path;
  } else {  // 64-bit integers, and floats that JSON has not
    EXPECT_EQ(view.Format(i), expected.get<std::string>()) << path;
  }
}

std::size_t CountLeaves(const json& value) {
  if (!value.is_structured()) return 1;
  std::size_t count = 0;
  for (const json& item : value) count += CountLeaves(item);
  return count;
}

/// "a[2].b" as "/a/2/b".
json::json_pointer PointerOf(std::string path) {
  std::string pointer = "/";
  for (const char c : path) {
    if (c == '.' || c == '[') pointer += '/';
    if (c != '.' && c != '[' && c != ']') pointer += c;
  }
  return json::json_pointer(pointer);
}

void ExpectMessage(const json& expected, const MessageType& type, const Bytes& message,
                   const std::string& where) {
  std::size_t leaves = 0;
  VisitLeaves(type, message, [&](const LeafPath& path, const FieldView& view) {
    const std::string text = where + " " + path.Text();
    const json& value = expected.at(PointerOf(path.Text()));
    leaves += view.size();
    if (!value.is_array()) return ExpectSame(value, view, 0, text);
    ASSERT_EQ(view.size(), value.size()) << text;
    for (std::size_t i = 0; i < view.size(); ++i) ExpectSame(value[i], view, i, text);
  });
  EXPECT_EQ(leaves, CountLeaves(expected)) << where;
}

/// The choice after all messages of a topic were shown.
TypeChoice ChoiceOf(const Topic& topic, const TypeResolver& resolver) {
  TypeChoice choice = resolver.Resolve(topic.schema);
  for (const Bytes& message : topic.messages) choice.Show(message);
  return choice;
}

TEST(Bags, Rosbag2MessagesEqualThoseOfAnotherReader) {
  const auto data = ReferenceData();
  if (!data) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const json summary = json::parse(std::ifstream(*data / "rosbag2/expected_summary.json"));
  const TypeResolver resolver;
  int compared = 0, refused = 0;
  for (const auto& [file, bag] : summary.items()) {
    const Topics topics = ReadBag(*data / "rosbag2" / file);
    for (const json& expected : bag.at("topics")) {
      const std::string name = expected.at("topic");
      if (expected.at("count") == 0 || !topics.contains(name)) continue;
      const Topic& topic = topics.at(name);
      const std::string where = file + " " + name;
      const TypeChoice choice = ChoiceOf(topic, resolver);
      const json& first = expected.at("first");
      if (first.contains("_undecoded_bytes") || first.contains("_error") ||
          first.contains("_hex")) {
        // The other reader takes the empty text of an empty message for none.
        const bool is_empty = topic.schema.type_name == "test_msgs/msg/Empty" &&
                              !topic.schema.schema_encoding.empty();
        EXPECT_EQ(choice.taken() == nullptr, !is_empty) << where << ": " << choice.Report();
        refused += is_empty ? 0 : 1;
        continue;
      }
      ASSERT_NE(choice.taken(), nullptr) << where << ": " << choice.Report();
      ExpectMessage(first, choice.taken()->type, topic.messages.front(), where);
      ++compared;
    }
  }
  EXPECT_GE(compared, 40);
  EXPECT_GE(refused, 8);
}

TEST(Bags, McapOfTheReferencesTopicsEqualsThatOfAnotherWriter) {
  const auto data = ReferenceData();
  if (!data) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const json expected =
      json::parse(std::ifstream(*data / "mcap/compressed/quad_zstd.expected.json"));
  Topics topics = ReadBag(*data / "mcap/compressed/quad_zstd.mcap");
  const TypeResolver resolver;
  for (const bool with_schema : {true, false}) {
    for (const json& topic : expected.at("topics")) {
      Topic& ours = topics.at(topic.at("topic"));
      if (!with_schema) ours.schema.schema_encoding.clear();  // then the built-in definitions
      const std::string where = topic.at("topic");
      const TypeChoice choice = ChoiceOf(ours, resolver);
      ASSERT_NE(choice.taken(), nullptr) << where << ": " << choice.Report();
      EXPECT_EQ(choice.Report(), with_schema ? "the bag" : "built in") << where;
      EXPECT_EQ(ours.messages.size(), topic.at("count").get<std::size_t>()) << where;
      ExpectMessage(topic.at("first"), choice.taken()->type, ours.messages.front(), where);
      // The other writer counts characters, not bytes, and so cuts the last text.
      if (where != "/log")
        ExpectMessage(topic.at("last"), choice.taken()->type, ours.messages.back(), where);
    }
  }
}

TEST(Bags, ARealPositionBagIsReadWithItsHeader) {
  const auto data = ReferenceData();
  if (!data) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const fs::path folder = *data / "logs/go2_vicon_orl/test_6_vicon_bag";
  const Topics topics = ReadBag(folder / "rosbag2_2025_12_05-14_46_48_0.db3");
  ASSERT_EQ(topics.size(), 1u);
  const Topic& topic = topics.begin()->second;
  const TypeChoice choice = ChoiceOf(topic, TypeResolver());
  ASSERT_NE(choice.taken(), nullptr) << choice.Report();
  EXPECT_EQ(choice.Report(), "built in, with header");
  // The authors' own export of the bag, in six digits: receive time, x, y, z, w, x, y, z.
  FieldReader reader(choice.taken()->type,
                     {"x_trans", "y_trans", "z_trans", "w", "x_rot", "y_rot", "z_rot"});
  std::ifstream csv(folder / "vicon_history.csv");
  std::size_t row = 0;
  for (std::string line; std::getline(csv, line); ++row) {
    ASSERT_LT(row, topic.messages.size());
    const auto values = reader.Read(topic.messages[row]);
    std::stringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    for (const FieldView& value : values) {
      ASSERT_TRUE(std::getline(cells, cell, ',')) << row;
      const double expected = std::stod(cell);
      ASSERT_NEAR(value.Double(), expected, 1e-5 * std::abs(expected)) << row;
    }
  }
  EXPECT_EQ(row, 7396u);
}

TEST(Bags, AnotherSerialisationIsRefusedInWords) {
  const auto data = ReferenceData();
  if (!data) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const Topics topics = ReadBag(
      *data /
      "rosbag2/ros2_rosbag2/rosbag2_tests/resources/mcap/wrong_rmw_test/wrong_rmw_test_0.mcap");
  ASSERT_EQ(topics.size(), 2u);
  for (const auto& [name, topic] : topics) {
    EXPECT_EQ(TypeResolver().Resolve(topic.schema).Report(),
              "encoding \"wrong_format\" is not decoded (cdr is)");
  }
}

TEST(Bags, EveryDefinitionThatRobotsUseIsRead) {
  const auto data = ReferenceData();
  if (!data) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const DefinitionFolder folder = ScanDefinitionFolder(*data / "msgs");
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(*data / "msgs")) {
    if (entry.path().extension() != ".msg" && entry.path().extension() != ".idl") continue;
    const std::string package = entry.path().parent_path().parent_path().filename();
    const std::string stem = entry.path().stem();
    const std::string type =
        package == "data" ? "interfaces/msg/" + stem : package + "/msg/" + stem;
    EXPECT_FALSE(
        folder.packages.Find(type).empty() && folder.loose.Find(type).empty() &&
        folder.packages.Find(entry.path().parent_path().filename().string() + "/msg/" + stem)
            .empty())
        << entry.path();
    ++read;
  }
  EXPECT_GT(read, 150);
}

}  // namespace
}  // namespace scoria::logs
