// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/mcap_log.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "logs/format/cdr.h"
#include "logs/format/mcap_writer.h"
#include "logs/format/open_log.h"
#include "logs/messages/scoria.h"
#include "logs/ros/type_resolver.h"
#include "tests/logs/format/log_lines.h"
#include "tests/support/db3_file.h"
#include "tests/support/mcap_file.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

/// A log that a test writes.
class McapLogTest : public testing::Test {
 protected:
  std::unique_ptr<LogSource> Open(const std::string& bytes) {
    core::WriteText(path_, bytes);
    return OpenLog(path_);
  }

  /// "topic time data" of each message, and what is wrong with the log then.
  static std::vector<std::string> Read(LogSource& log, const LogFilter& filter = {}) {
    std::vector<std::string> messages;
    log.ForEach(filter, [&](const LogMessage& m) {
      messages.push_back(fmt::format("{} {} {}", m.channel.topic, m.log_time_ns, TextOf(m.data)));
    });
    return messages;
  }
  static std::string TextOf(std::span<const std::byte> data) {
    return {reinterpret_cast<const char*>(data.data()), data.size()};
  }
  /// What is wrong, without the file's name.
  static std::vector<std::string> ProblemsOf(const LogSource& log) {
    std::vector<std::string> all;
    for (const LogProblem& p : log.problems()) all.push_back(p.what);
    return all;
  }

  test::TemporaryFolder folder_;
  fs::path path_ = folder_.path() / "a.mcap";
};

const std::string kDefinitions = test::McapSchema(1, "pkg/msg/A", "ros2msg", "int8 a") +
                                 test::McapChannel(1, 1, "/a", "cdr") +
                                 test::McapChannel(2, 1, "/b", "cdr");

/// Two topics in chunks of some ten messages each, as our writer makes them.
void WriteTwoTopics(const fs::path& path) {
  McapWriter writer(path, 400);
  writer.AddMetadata("note", {{"key", "value"}});
  const auto a = writer.AddChannel("/a", "pkg/msg/A", "int8 a");
  const auto b = writer.AddChannel("/b", "pkg/msg/B", "int8 b");
  const Bytes data(20);
  for (int i = 0; i < 100; ++i) writer.Write(i < 50 ? a : b, 1'000'000 * i, data);
}

TEST_F(McapLogTest, ReadsWhatOurWriterWrites) {
  WriteTwoTopics(path_);
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  const LogContents& contents = log->contents();
  EXPECT_EQ(contents.format, "an MCAP log");
  ASSERT_EQ(contents.channels.size(), 2u);
  const LogChannel& b = contents.channels[1];
  EXPECT_EQ(b.topic, "/b");
  EXPECT_EQ(b.type_name, "pkg/msg/B");
  EXPECT_EQ(b.schema, (LogSchema{"ros2msg", "int8 b"}));
  EXPECT_EQ(b.message_encoding, "cdr");
  EXPECT_TRUE(b.metadata.contains("offered_qos_profiles"));
  EXPECT_EQ(b.message_count, 50u);
  EXPECT_EQ(b.span, (LogSpan{50'000'000, 99'000'000}));
  EXPECT_EQ(contents.span, (LogSpan{0, 99'000'000}));
  EXPECT_TRUE(contents.can_order_by_time);
  EXPECT_EQ(contents.metadata.at("note").at("key"), "value");
  std::uint32_t count = 0;
  log->ForEach({}, [&](const LogMessage& m) {
    EXPECT_EQ(m.channel_index, count < 50 ? 0u : 1u);
    EXPECT_EQ(m.log_time_ns, 1'000'000 * count);
    EXPECT_EQ(m.publish_time_ns, 1'000'000 * count);
    EXPECT_EQ(m.sequence, count % 50);
    EXPECT_EQ(m.data.size(), 20u);
    ++count;
  });
  EXPECT_EQ(count, 100u);
  EXPECT_EQ(ProblemsOf(*log), Lines{});
}

TEST_F(McapLogTest, ChannelsOfOneTypeWithTwoSchemasKeepBoth) {
  {
    McapWriter writer(path_);
    for (const char* text : {"float64[10] x", "float64[20] x", "float64[10] x"})
      writer.Write(writer.AddChannel("/a", "pkg/msg/A", text), 1, {});
  }
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  const std::vector<LogChannel>& channels = log->contents().channels;
  ASSERT_EQ(channels.size(), 3u);
  EXPECT_EQ(channels[0].schema->text, "float64[10] x");
  EXPECT_EQ(channels[1].schema->text, "float64[20] x");
  EXPECT_EQ(channels[2].schema->text, "float64[10] x");
}

TEST_F(McapLogTest, StopsWhereItIsToldTo) {
  WriteTwoTopics(path_);
  int count = 0;
  OpenLog(path_)->ForEach({}, [&](const LogMessage&) { return ++count < 7; });
  EXPECT_EQ(count, 7);
}

TEST_F(McapLogTest, ExceptionOfTheConsumerIsNoDamage) {
  WriteTwoTopics(path_);
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  struct Mine {};
  EXPECT_THROW(log->ForEach({}, [](const LogMessage&) { throw Mine{}; }), Mine);
  EXPECT_THROW(log->ForEach({}, [](const LogMessage&) { throw std::runtime_error("mine"); }),
               std::runtime_error);
  EXPECT_EQ(ProblemsOf(*log), Lines{});
  EXPECT_EQ(Read(*log).size(), 100u) << "and it can be read again";
}

/// Chunks that hold nothing wanted are not even looked at: they could be damaged.
TEST_F(McapLogTest, FiltersReadOnlyTheChunksThatHoldWhatTheyWant) {
  WriteTwoTopics(path_);
  std::string bytes = core::ReadText(path_);
  const std::size_t first_chunk = bytes.find("zstd");
  bytes[first_chunk + 20] ^= 1;
  const std::unique_ptr<LogSource> log = Open(bytes);
  EXPECT_EQ(Read(*log, {.topics = {{"/b"}}}).size(), 50u);
  EXPECT_EQ(Read(*log, {.topics = {{"/none"}}}), Lines{});
  EXPECT_EQ(Read(*log, {.from_ns = 60'500'000, .to_ns = 70'000'000}).size(), 10u);
  EXPECT_EQ(ProblemsOf(*log), Lines{});
  EXPECT_LT(Read(*log, {.topics = {{"/a"}}}).size(), 50u);
  ASSERT_EQ(log->problems().size(), 1u);
  EXPECT_EQ(log->problems()[0].kind, LogProblem::Kind::kLost);
}

TEST_F(McapLogTest, TimesComeInOrderAndEqualOnesAsStored) {
  using test::McapMessage;
  const std::unique_ptr<LogSource> plain =
      Open(test::McapFile(kDefinitions + McapMessage(1, 30, "x") + McapMessage(2, 10, "y") +
                          McapMessage(1, 10, "z") + McapMessage(1, 20, "w")));
  EXPECT_TRUE(plain->contents().can_order_by_time);
  EXPECT_EQ(Read(*plain), (Lines{"/b 10 y", "/a 10 z", "/a 20 w", "/a 30 x"}));
  EXPECT_EQ(Read(*plain, {.order = LogOrder::kStored}),
            (Lines{"/a 30 x", "/b 10 y", "/a 10 z", "/a 20 w"}));
  EXPECT_EQ(ProblemsOf(*plain), Lines{});

  const std::unique_ptr<LogSource> chunks = Open(test::McapFile(
      test::ToChunk(kDefinitions + McapMessage(1, 10, "x") + McapMessage(1, 30, "y"), 10, 30)
          .ToRecord() +
      test::ToPackedChunk(McapMessage(2, 20, "z") + McapMessage(2, 30, "w"), 20, 30).ToRecord() +
      test::ToChunk(McapMessage(2, 5, "v"), 5, 5).ToRecord()));
  EXPECT_EQ(Read(*chunks), (Lines{"/b 5 v", "/a 10 x", "/b 20 z", "/a 30 y", "/b 30 w"}));
  EXPECT_EQ(Read(*chunks, {.order = LogOrder::kStored}),
            (Lines{"/a 10 x", "/a 30 y", "/b 20 z", "/b 30 w", "/b 5 v"}));
  EXPECT_EQ(Read(*chunks, {.topics = {{"/b"}}, .from_ns = 6}), (Lines{"/b 20 z", "/b 30 w"}));
  EXPECT_EQ(chunks->contents().channels[1].message_count, 3u);
  EXPECT_EQ(chunks->contents().channels[1].span, (LogSpan{5, 30}));
}

/// Three chunks of 100 MiB that all overlap are too much to be held at once.
TEST_F(McapLogTest, WhatOverlapsTooMuchComesAsStoredAndSaysSo) {
  const std::string large(100 << 20, '\0');
  std::string records = kDefinitions;
  for (const std::uint64_t first : {2, 1, 3}) {
    const std::string inner = test::McapMessage(1, first, large) + test::McapMessage(2, 9, "end");
    records += test::ToPackedChunk(inner, first, 9).ToRecord();
  }
  const std::unique_ptr<LogSource> log = Open(test::McapFile(records));
  EXPECT_FALSE(log->contents().can_order_by_time);
  std::vector<std::int64_t> times;
  log->ForEach({.topics = {{"/a"}}}, [&](const LogMessage& m) { times.push_back(m.log_time_ns); });
  EXPECT_EQ(times, (std::vector<std::int64_t>{2, 1, 3}));
}

TEST_F(McapLogTest, ListsChannelsWithoutMessages) {
  const std::unique_ptr<LogSource> log =
      Open(test::McapFile(kDefinitions + test::McapMessage(1, 1, "x"),
                          test::McapChannel(7, 0, "/only_in_the_summary", "json")));
  ASSERT_EQ(log->contents().channels.size(), 3u);
  EXPECT_EQ(log->contents().channels[1].topic, "/b");
  EXPECT_EQ(log->contents().channels[1].message_count, 0u);
  EXPECT_FALSE(log->contents().channels[1].span.has_value());
  EXPECT_EQ(log->contents().channels[2].topic, "/only_in_the_summary");
  EXPECT_FALSE(log->contents().channels[2].schema.has_value());
  EXPECT_EQ(ProblemsOf(*log), Lines{});
}

TEST_F(McapLogTest, ChannelsOnOneTopicStayApart) {
  const std::unique_ptr<LogSource> log = Open(test::McapFile(
      test::McapSchema(1, "pkg/msg/A", "ros2msg", "int8 a") +
      test::McapSchema(2, "pkg/msg/A", "ros2idl", "module pkg {}") +
      test::McapChannel(1, 1, "/a", "cdr") + test::McapChannel(5, 2, "/a", "cdr") +
      test::McapMessage(5, 1, "x") + test::McapMessage(1, 2, "y") + test::McapMessage(5, 3, "z")));
  ASSERT_EQ(log->contents().channels.size(), 2u);
  std::vector<std::size_t> channels;
  log->ForEach({.topics = {{"/a"}}}, [&](const LogMessage& m) {
    channels.push_back(m.channel_index);
    EXPECT_EQ(&m.channel, &log->contents().channels[m.channel_index]);
  });
  EXPECT_EQ(channels, (std::vector<std::size_t>{1, 0, 1}));
  EXPECT_EQ(log->contents().channels[1].schema->encoding, "ros2idl");
}

/// They are listed with counts and can be read; that nobody decodes them is no fault of the log.
TEST_F(McapLogTest, ChannelsOfOtherEncodingsAreListedAndNamed) {
  const std::string descriptor("\x0a\x00\xff", 3);
  const std::unique_ptr<LogSource> log = Open(test::McapFile(
      test::McapSchema(1, "pkg.A", "protobuf", descriptor) +
      test::McapSchema(2, "B", "jsonschema", "{}") + test::McapSchema(3, "C", "flatbuffer", "") +
      test::McapSchema(4, "pkg/msg/D", "omgidl", "struct D {};") +
      test::McapChannel(1, 1, "/a", "protobuf") + test::McapChannel(2, 2, "/b", "json") +
      test::McapChannel(3, 3, "/c", "flatbuffer") + test::McapChannel(4, 4, "/d", "cdr") +
      test::McapChannel(5, 0, "/e", "json") + test::McapMessage(1, 1, "1") +
      test::McapMessage(2, 2, "{}") + test::McapMessage(2, 3, "{}") + test::McapMessage(3, 4, "3") +
      test::McapMessage(4, 5, "4") + test::McapMessage(5, 6, "5")));
  EXPECT_EQ(Read(*log), (Lines{"/a 1 1", "/b 2 {}", "/b 3 {}", "/c 4 3", "/d 5 4", "/e 6 5"}));
  EXPECT_EQ(ProblemsOf(*log), Lines{});
  const std::vector<LogChannel>& channels = log->contents().channels;
  EXPECT_EQ(channels.at(0).schema, (LogSchema{"protobuf", descriptor}));
  EXPECT_EQ(channels.at(1).message_count, 2u);
  EXPECT_EQ(channels.at(1).span, (LogSpan{2, 3}));
  EXPECT_FALSE(channels.at(4).schema);
  const TypeResolver resolver;
  Lines reports;
  for (const LogChannel& c : channels) {
    const LogSchema schema = c.schema.value_or(LogSchema{});
    reports.push_back(
        resolver.Resolve({c.type_name, c.message_encoding, schema.encoding, schema.text}).Report());
  }
  EXPECT_EQ(reports, (Lines{"encoding \"protobuf\" is not decoded (cdr is)",
                            "encoding \"json\" is not decoded (cdr is)",
                            "encoding \"flatbuffer\" is not decoded (cdr is)",
                            "schema encoding \"omgidl\" is not decoded (ros2msg and ros2idl are)",
                            "encoding \"json\" is not decoded (cdr is)"}));
}

TEST_F(McapLogTest, EveryCompressionHoldsTheSame) {
  const std::string inner = kDefinitions + test::McapMessage(1, 1, std::string(10000, 'x')) +
                            test::McapMessage(2, 2, "y");
  const Lines expected = {"/a 1 " + std::string(10000, 'x'), "/b 2 y"};
  for (const test::McapChunk& chunk : {test::ToChunk(inner, 1, 2), test::ToPackedChunk(inner, 1, 2),
                                       test::ToPackedChunk(inner, 1, 2, "lz4")}) {
    const std::unique_ptr<LogSource> log = Open(test::McapFile(chunk.ToRecord()));
    EXPECT_EQ(Read(*log), expected) << chunk.compression;
    EXPECT_EQ(ProblemsOf(*log), Lines{});
  }
}

TEST_F(McapLogTest, MessagesThatAreZstdFramesAreUnpacked) {
  const std::string cut = test::Zstd(std::string(5000, 'a'), true);
  const std::unique_ptr<LogSource> log = Open(test::McapFile(
      kDefinitions + test::McapMessage(1, 1, test::Zstd("said", true)) +
      test::McapMessage(1, 2, cut.substr(0, cut.size() - 3)) +
      test::McapMessage(2, 3, test::Zstd("streamed", false)) + test::McapMessage(2, 4, "plain")));
  EXPECT_EQ(Read(*log), (Lines{"/a 1 said", "/b 3 streamed", "/b 4 plain"}));
  EXPECT_EQ(ProblemsOf(*log), Lines{"messages of /a are lost: they do not decompress"});
}

TEST_F(McapLogTest, UnknownSchemasAndChannelsAreNamed) {
  const std::unique_ptr<LogSource> log = Open(test::McapFile(
      test::McapChannel(1, 0, "/bare", "json") + test::McapChannel(3, 9, "/c", "cdr") +
      test::McapMessage(1, 1, "{}") + test::McapMessage(3, 2, "x") + test::McapMessage(4, 3, "y") +
      test::McapMessage(4, 4, "z")));
  EXPECT_EQ(ProblemsOf(*log),
            Lines{"channel 3 (/c) is of schema 9, which the file does not define"});
  EXPECT_EQ(log->problems()[0].kind, LogProblem::Kind::kOdd);
  EXPECT_EQ(Read(*log), (Lines{"/bare 1 {}", "/c 2 x"}));
  ASSERT_EQ(log->problems().size(), 2u);
  EXPECT_EQ(log->problems()[1].what, "messages of channel 4 are lost: the file does not define it");
  EXPECT_EQ(log->problems()[1].kind, LogProblem::Kind::kLost);
}

TEST_F(McapLogTest, SecondDefinitionOfANumberIsNamed) {
  const std::unique_ptr<LogSource> log =
      Open(test::McapFile(kDefinitions + test::McapMessage(1, 1, "x") +
                          test::McapSchema(1, "pkg/msg/A", "ros2msg", "int16 a") +
                          test::McapChannel(2, 1, "/other", "cdr") + test::McapMessage(2, 2, "y")));
  EXPECT_EQ(Read(*log), (Lines{"/a 1 x", "/b 2 y"}));
  const std::vector<std::string> problems = ProblemsOf(*log);
  ASSERT_GE(problems.size(), 2u);
  EXPECT_NE(problems[0].find("schema 1 is defined twice, as pkg/msg/A and as pkg/msg/A with "
                             "another text; the first is used"),
            std::string::npos)
      << problems[0];
  EXPECT_NE(problems[1].find("channel 2 is defined twice, as /b and as /other; the first is used"),
            std::string::npos)
      << problems[1];
}

TEST_F(McapLogTest, AttachmentsTravelUnchanged) {
  Bytes data(100000);
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = static_cast<std::byte>(i * i);
  {
    McapWriter writer(path_);
    writer.AddMetadata("before", {});
    writer.AddAttachment({"ground.zst", "application/zstd", data});
    writer.AddMetadata("after", {{"key", "value"}});
  }
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  const auto found = log->ReadAttachment("ground.zst");
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->media_type, "application/zstd");
  EXPECT_EQ(found->data, data);
  EXPECT_EQ(log->contents().attachments, Lines{"ground.zst"});
  EXPECT_FALSE(log->ReadAttachment("other").has_value());
  EXPECT_EQ(log->contents().metadata.at("after").at("key"), "value");

  std::string bytes = core::ReadText(path_);
  bytes[bytes.find("application/zstd") + 5000] ^= 1;
  const std::unique_ptr<LogSource> damaged = Open(bytes);
  try {
    (void)damaged->ReadAttachment("ground.zst");
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(": wrong checksum"), std::string::npos) << e.what();
  }
  const std::unique_ptr<LogSource> cut = Open(bytes.substr(0, 5000));
  EXPECT_TRUE(LosesData(cut->problems()));
  EXPECT_FALSE(cut->ReadAttachment("ground.zst").has_value());
}

TEST_F(McapLogTest, AttachmentsAndMetadataAreFoundWithoutAnIndex) {
  const std::unique_ptr<LogSource> log =
      Open(test::McapFile(test::McapAttachment("notes.txt", "text") + test::McapMetadata("m")));
  EXPECT_EQ(log->contents().attachments, Lines{"notes.txt"});
  EXPECT_EQ(log->ReadAttachment("notes.txt")->data.size(), 4u);
  EXPECT_TRUE(log->contents().metadata.contains("m"));
  EXPECT_FALSE(log->contents().span.has_value());
  EXPECT_EQ(Read(*log), Lines{});
}

}  // namespace
}  // namespace scoria::logs
