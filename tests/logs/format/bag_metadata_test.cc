// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/bag_metadata.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/logs/format/log_lines.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

BagMetadata Parse(const std::string& text) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / kBagMetadata) << text;
  return ReadBagMetadata(folder.path() / kBagMetadata);
}

/// As each version has it; what scoria needs stayed the same in all of them.
std::string Text(int version) {
  std::string text = fmt::format(
      "rosbag2_bagfile_information:\n"
      "  version: {}\n"
      "  storage_identifier: sqlite3\n"
      "  relative_file_paths:\n    - {}walk_0.db3\n    - {}walk_1.db3\n"
      "  duration:\n    nanoseconds: 90\n"
      "  starting_time:\n    nanoseconds_since_epoch: 10\n"
      "  message_count: 12\n"
      "  topics_with_message_count:\n"
      "    - topic_metadata:\n        name: /a\n        type: pkg/msg/A\n"
      "        serialization_format: cdr\n",
      version, version == 2 ? "walk/" : "", version == 2 ? "walk/" : "");
  const std::string infinite = "sec: 9223372036, nsec: 854775807";
  if (version >= 9) {
    text +=
        "        offered_qos_profiles:\n          - history: keep_last\n            depth: 10\n"
        "            lifespan: {" +
        infinite + "}\n";
  } else if (version >= 4) {
    text += "        offered_qos_profiles: \"- history: 3\\n  depth: 0\"\n";
  }
  if (version >= 7) text += "        type_description_hash: RIHS01_1234\n";
  text += "      message_count: 12\n";
  if (version >= 3) text += "  compression_format: \"\"\n  compression_mode: \"\"\n";
  if (version >= 5)
    text +=
        "  files:\n    - path: walk_0.db3\n      starting_time:\n"
        "        nanoseconds_since_epoch: 10\n      duration:\n        nanoseconds: 90\n"
        "      message_count: 12\n";
  if (version >= 6) text += "  custom_data: ~\n";
  if (version >= 8) text += "  ros_distro: jazzy\n";
  return text;
}

TEST(BagMetadata, EveryVersionSaysTheSame) {
  for (int version = 2; version <= 10; ++version) {
    SCOPED_TRACE(version);
    const BagMetadata metadata = Parse(Text(version));
    const std::string folder = version == 2 ? "walk/" : "";
    EXPECT_EQ(metadata.files, (Lines{folder + "walk_0.db3", folder + "walk_1.db3"}));
    EXPECT_EQ(metadata.message_count, 12u);
    EXPECT_EQ(metadata.topics, (std::map<std::string, BagTopic>{{"/a", {12, "pkg/msg/A", "cdr"}}}));
    EXPECT_EQ(metadata.span, (LogSpan{10, 100}));
  }
}

TEST(BagMetadata, WhatIsNotThereOrInAnotherFormIsAbsent) {
  const BagMetadata metadata = Parse(
      "rosbag2_bagfile_information: {relative_file_paths: x.db3, message_count: many, "
      "starting_time: 7, duration: [1], topics_with_message_count: [1, {message_count: 3}]}");
  EXPECT_TRUE(metadata.files.empty());
  EXPECT_FALSE(metadata.message_count);
  EXPECT_FALSE(metadata.span);
  EXPECT_TRUE(metadata.topics.empty());
  EXPECT_FALSE(Parse("rosbag2_bagfile_information: {message_count: 0, duration: {nanoseconds: 0}, "
                     "starting_time: {nanoseconds_since_epoch: 9223372036854775807}}")
                   .span)
      << "an empty bag has none";
  EXPECT_FALSE(Parse("rosbag2_bagfile_information: {message_count: 1, duration: {nanoseconds: 2}, "
                     "starting_time: {nanoseconds_since_epoch: 9223372036854775807}}")
                   .span);
}

TEST(BagMetadata, WhatIsNoMetadataIsAnError) {
  EXPECT_THROW((void)Parse("a: ["), std::runtime_error);
  EXPECT_THROW((void)Parse(""), std::runtime_error);
  EXPECT_THROW((void)Parse("just text"), std::runtime_error);
  EXPECT_THROW((void)Parse("rosbag2: {}"), std::runtime_error);
}

TEST(BagMetadata, DifferencesFromTheFilesAreSentences) {
  LogContents contents;
  contents.span = {1'500'000'000, 3'000'000'000};
  LogChannel a, b;
  a.topic = "/a";
  a.message_count = 5;
  b.topic = "/b";
  b.message_count = 2;
  b.type_name = "pkg/msg/B";
  b.message_encoding = "cdr";
  contents.channels = {a, b};
  BagMetadata metadata;
  EXPECT_EQ(CompareMetadata(metadata, contents), Lines{}) << "what it does not say is not wrong";
  metadata.message_count = 7;
  metadata.topics = {{"/a", {5, "", ""}}, {"/b", {2, "pkg/msg/B", "cdr"}}};
  metadata.span = contents.span;
  EXPECT_EQ(CompareMetadata(metadata, contents), Lines{});
  metadata.topics["/b"] = {1, "pkg/B", "wrong_format"};
  EXPECT_EQ(CompareMetadata(metadata, contents),
            Lines{"is wrong about /b (2, not 1; pkg/msg/B, not pkg/B; cdr, not wrong_format)"});
  metadata.topics = {{"/a", {6, "", ""}}, {"/c", {3, "A", "cdr"}}, {"/empty", {0, "A", "cdr"}}};
  metadata.message_count = 9;
  metadata.span = LogSpan{1'000'000'000, 4'000'000'000};
  EXPECT_EQ(CompareMetadata(metadata, contents),
            (Lines{"counts 9 messages, the files have 7",
                   "is wrong about /a (5, not 6), /c (0, not 3), /b (it has none of that name)",
                   "has other times: it begins -0.500 s and ends +1.000 s from the files' "
                   "messages"}));
  contents.channels[0].message_count.reset();
  EXPECT_EQ(CompareMetadata(metadata, contents), Lines{}) << "counts are not known yet";
}

}  // namespace
}  // namespace scoria::logs
