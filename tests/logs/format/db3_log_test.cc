// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/db3_log.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/files.h"
#include "logs/format/open_log.h"
#include "tests/logs/format/log_lines.h"
#include "tests/support/db3_file.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;
using test::Db3Era;
using test::Db3File;

class Db3LogTest : public testing::Test {
 protected:
  /// What OpenLog says, without the folder.
  std::string OpenError() {
    try {
      (void)OpenLog(path_);
    } catch (const std::runtime_error& e) {
      return std::string(e.what()).substr(folder_.path().string().size() + 1);
    }
    return "";
  }

  test::TemporaryFolder folder_;
  fs::path path_ = folder_.path() / "bag ?#%.db3";  // as no URI may have it
};

TEST_F(Db3LogTest, EveryEraIsReadByItsColumns) {
  for (const Db3Era era : {Db3Era::kFirst, Db3Era::kQos, Db3Era::kMetadata, Db3Era::kDefinitions}) {
    SCOPED_TRACE(static_cast<int>(era));
    fs::remove(path_);
    {
      Db3File file(path_, era);
      file.AddTopic(4, "/a", "pkg/msg/A", "cdr", era == Db3Era::kDefinitions ? "RIHS01_a" : "");
      file.AddTopic(2, "/none", "pkg/msg/B", "json");
      file.AddMessage(4, 20, "x");
      file.AddMessage(4, 30, "y");
      if (era == Db3Era::kDefinitions)
        file.AddDefinition("pkg/msg/A", "ros2msg", "int8 a", "RIHS01_a");
    }
    const std::unique_ptr<LogSource> log = OpenLog(path_);
    EXPECT_EQ(log->contents().path, path_);
    EXPECT_EQ(log->contents().format, "a rosbag2 bag (sqlite3)");
    EXPECT_EQ(log->contents().span, (LogSpan{20, 30}));
    ASSERT_EQ(log->contents().channels.size(), 2u);
    const LogChannel& none = log->contents().channels[0];
    EXPECT_EQ(none.topic + " " + none.type_name + " " + none.message_encoding,
              "/none pkg/msg/B json");
    EXPECT_EQ(none.message_count, 0u);
    EXPECT_FALSE(none.span);
    EXPECT_FALSE(none.schema);
    const LogChannel& a = log->contents().channels[1];
    EXPECT_EQ(a.topic + " " + a.type_name + " " + a.message_encoding, "/a pkg/msg/A cdr");
    EXPECT_EQ(a.message_count, 2u);
    EXPECT_EQ(a.span, (LogSpan{20, 30}));
    EXPECT_EQ(a.metadata.contains("offered_qos_profiles"), era >= Db3Era::kQos);
    EXPECT_EQ(a.metadata.contains("topic_type_hash"), era == Db3Era::kDefinitions);
    EXPECT_EQ(a.schema.has_value(), era == Db3Era::kDefinitions);
    if (a.schema) {
      EXPECT_EQ(*a.schema, (LogSchema{"ros2msg", "int8 a"}));
    }
    if (era >= Db3Era::kMetadata) {
      EXPECT_EQ(log->contents().metadata.at("rosbag2"),
                (LogMetadata{{"ROS_DISTRO", "jazzy"}, {"serialized_metadata", "last"}}));
    }
    EXPECT_EQ(MessagesOf(*log), (Lines{"/a 20 x", "/a 30 y"}));
    EXPECT_EQ(ProblemsOf(*log), Lines{});
    EXPECT_FALSE(log->ReadAttachment("any"));
  }
}

/// The first recorder had no other serialisation than CDR and did not say so.
TEST_F(Db3LogTest, TopicsWithoutSerialisationAreCdr) {
  test::RunSql(path_,
               "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT);"
               "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, "
               "data BLOB);"
               "INSERT INTO topics VALUES (1, '/a', 'pkg/A')");
  EXPECT_EQ(OpenLog(path_)->contents().channels.at(0).message_encoding, "cdr");
}

TEST_F(Db3LogTest, DefinitionsOfOneTypeAreToldApartByTheirHash) {
  {
    Db3File file(path_, Db3Era::kDefinitions);
    file.AddTopic(1, "/old", "pkg/msg/A", "cdr", "RIHS01_old");
    file.AddTopic(2, "/new", "pkg/msg/A", "cdr", "RIHS01_new");
    file.AddTopic(3, "/without", "pkg/msg/A", "cdr", "");
    file.AddTopic(4, "/unknown", "pkg/msg/U", "cdr", "");
    file.AddTopic(5, "/empty", "pkg/msg/Empty", "cdr", "");
    file.AddDefinition("pkg/msg/A", "ros2msg", "int8 new", "RIHS01_new");
    file.AddDefinition("pkg/msg/A", "ros2msg", "int8 old", "RIHS01_old");
    file.AddDefinition("pkg/msg/U", "unknown", "");
    file.AddDefinition("pkg/msg/Empty", "ros2msg", "");
  }
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  const std::vector<LogChannel>& channels = log->contents().channels;
  EXPECT_EQ(channels.at(0).schema->text, "int8 old");
  EXPECT_EQ(channels.at(1).schema->text, "int8 new");
  EXPECT_TRUE(channels.at(2).schema.has_value());
  EXPECT_FALSE(channels.at(3).schema.has_value());
  EXPECT_EQ(channels.at(4).schema, (LogSchema{"ros2msg", ""}));
}

TEST_F(Db3LogTest, TimesComeInOrderAndEqualOnesAsStored) {
  {
    Db3File file(path_, Db3Era::kQos);
    file.AddTopic(1, "/a", "A");
    file.AddTopic(2, "/b", "B");
    file.AddMessage(1, 30, "1");
    file.AddMessage(2, 10, "2");
    file.AddMessage(1, 10, "3");
    file.AddMessage(2, -5, "4");
    file.Run("DROP INDEX timestamp_idx");
  }
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  EXPECT_TRUE(log->contents().can_order_by_time);
  EXPECT_EQ(MessagesOf(*log), (Lines{"/b -5 4", "/b 10 2", "/a 10 3", "/a 30 1"}));
  EXPECT_EQ(MessagesOf(*log, {.order = LogOrder::kStored}),
            (Lines{"/a 30 1", "/b 10 2", "/a 10 3", "/b -5 4"}));
  EXPECT_EQ(MessagesOf(*log, {.topics = {{"/a"}}}), (Lines{"/a 10 3", "/a 30 1"}));
  EXPECT_EQ(MessagesOf(*log, {.from_ns = 0, .to_ns = 10}), (Lines{"/b 10 2", "/a 10 3"}));
  EXPECT_EQ(MessagesOf(*log, {.from_ns = 31}), Lines{});
}

TEST_F(Db3LogTest, MessagesOfUndefinedTopicsAreNamed) {
  {
    Db3File file(path_, Db3Era::kQos);
    file.AddTopic(1, "/a", "A");
    file.AddMessage(1, 1, "x");
    file.AddMessage(7, 2, "y");
    file.AddMessage(7, 3, "z");
  }
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  EXPECT_EQ(MessagesOf(*log), Lines{"/a 1 x"});
  EXPECT_EQ(
      ProblemsOf(*log),
      Lines{"bag ?#%.db3: 2 messages of topic number 7 are lost: the bag does not define it"});
}

TEST_F(Db3LogTest, MessagesThatAreZstdFramesAreUnpacked) {
  const std::string large(300'000, 'l');
  const std::string cut = test::Zstd(std::string(5000, 'a'), true);
  {
    Db3File file(path_, Db3Era::kQos);
    file.AddTopic(1, "/a", "A");
    file.AddMessage(1, 1, test::Zstd("said", true));
    file.AddMessage(1, 2, test::Zstd("streamed", false));
    file.AddMessage(1, 3, "plain");
    file.AddMessage(1, 4, cut.substr(0, cut.size() - 3));
    file.AddMessage(1, 5, test::Zstd(large, false));
    file.AddMessage(1, 6, test::Zstd("", true));
  }
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  EXPECT_EQ(MessagesOf(*log),
            (Lines{"/a 1 said", "/a 2 streamed", "/a 3 plain", "/a 5 " + large, "/a 6 "}));
  EXPECT_EQ(ProblemsOf(*log),
            Lines{"bag ?#%.db3: messages of /a are lost: they do not decompress"});
}

/// A few kB that unpack to 1 GiB are no message.
TEST_F(Db3LogTest, MessagesThatGrowWithoutBoundAreRefused) {
  {
    Db3File file(path_, Db3Era::kQos);
    file.AddTopic(1, "/a", "A");
    file.AddMessage(1, 1, test::ZstdBomb(std::uint64_t{300} << 20, false));
    file.AddMessage(1, 2, "x");
  }
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  EXPECT_EQ(MessagesOf(*log), Lines{"/a 2 x"});
  EXPECT_EQ(ProblemsOf(*log).size(), 1u);
}

TEST_F(Db3LogTest, DatabasesOfOthersAreNamed) {
  test::RunSql(path_, "CREATE TABLE users(id INTEGER); CREATE TABLE mails(id INTEGER)");
  EXPECT_EQ(OpenError(),
            "bag ?#%.db3: is an SQLite database, not a bag: it has no table topics "
            "(but users, mails)");
  test::RunSql(path_,
               "CREATE TABLE topics(id INTEGER, name TEXT, type TEXT);"
               "CREATE VIEW messages AS SELECT 1 AS topic_id, 2 AS timestamp, 3 AS data");
  EXPECT_EQ(OpenError(),
            "bag ?#%.db3: is an SQLite database, not a bag: it has no table messages "
            "(but users, mails, topics)");
  test::RunSql(path_, "DROP VIEW messages; CREATE TABLE messages(topic_id INTEGER, data BLOB)");
  EXPECT_EQ(OpenError(),
            "bag ?#%.db3: is an SQLite database, not a bag: its table messages has no "
            "column timestamp");
  fs::remove(path_);
  std::ofstream(path_) << "SQLite format 3" << std::string(2000, '\0');
  EXPECT_EQ(OpenError(),
            "bag ?#%.db3: is an SQLite database that is damaged: file is not a database");
}

}  // namespace
}  // namespace scoria::logs
