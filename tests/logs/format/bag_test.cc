// SPDX-License-Identifier: BSD-3-Clause
// Whole bags: folders with splits, metadata.yaml and compressed files.
#include <fstream>

#include <gtest/gtest.h>

#include "core/files.h"
#include "logs/format/open_log.h"
#include "tests/logs/format/log_lines.h"
#include "tests/support/db3_file.h"
#include "tests/support/mcap_file.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;
using test::Db3Era;
using test::Db3File;

class BagTest : public testing::Test {
 protected:
  /// A split with messages of /a at these times; each says which file it is from.
  void Split(const std::string& name, std::initializer_list<int> times) {
    fs::remove(folder_ / name);
    Db3File file(folder_ / name, Db3Era::kQos);
    file.AddTopic(1, "/a", "pkg/msg/A");
    for (const int time : times) file.AddMessage(1, time, name.substr(0, name.find('.')));
  }
  /// Replaces a file by its zstd frame.
  void Pack(const std::string& name, bool says_size = false, double share = 1.0) {
    const std::string packed = test::Zstd(core::ReadText(folder_ / name), says_size);
    Write(name + ".zstd",
          packed.substr(0, static_cast<std::size_t>(share * static_cast<double>(packed.size()))));
    fs::remove(folder_ / name);
  }
  void Write(const std::string& name, const std::string& content) {
    std::ofstream(folder_ / name, std::ios::binary) << content;
  }
  /// metadata.yaml of a bag with these files and messages of /a.
  void WriteMetadata(const std::string& files, int messages, const std::string& more = "") {
    Write("metadata.yaml",
          fmt::format("rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: sqlite3\n"
                      "  relative_file_paths: [{}]\n  message_count: {}\n"
                      "  topics_with_message_count:\n    - topic_metadata: {{name: /a}}\n"
                      "      message_count: {}\n{}",
                      files, messages, messages, more));
  }
  /// What OpenLog says of the folder, without the folder.
  std::string OpenError() {
    try {
      (void)OpenLog(folder_);
    } catch (const std::runtime_error& e) {
      std::string text = e.what();
      for (std::size_t at; (at = text.find(folder_.string())) != std::string::npos;)
        text.replace(at, folder_.string().size(), "BAG");
      return text;
    }
    return "";
  }

  test::TemporaryFolder temporary_;
  fs::path folder_ = [this] {
    fs::create_directory(temporary_.path() / "walk");
    return temporary_.path() / "walk";
  }();
};

TEST_F(BagTest, SplitsAreReadInTheOrderOfTimeAlsoWhereTheyOverlap) {
  Split("walk_0.db3", {50, 60});
  Split("walk_1.db3", {10, 30, 30});
  Split("walk_2.db3", {20, 30, 55});
  Split("walk_10.db3", {70});
  Split("walk_9.db3", {});
  WriteMetadata("walk_0.db3, walk_1.db3, walk_2.db3, walk_9.db3, walk_10.db3", 9);
  const std::unique_ptr<LogSource> log = OpenLog(folder_);
  EXPECT_EQ(log->contents().path, folder_);
  EXPECT_EQ(log->contents().format, "a rosbag2 bag (sqlite3) in 5 files");
  EXPECT_EQ(log->contents().span, (LogSpan{10, 70}));
  ASSERT_EQ(log->contents().channels.size(), 1u);
  EXPECT_EQ(log->contents().channels[0].message_count, 9u);
  EXPECT_EQ(log->contents().channels[0].span, (LogSpan{10, 70}));
  EXPECT_EQ(MessagesOf(*log),
            (Lines{"/a 10 walk_1", "/a 20 walk_2", "/a 30 walk_1", "/a 30 walk_1", "/a 30 walk_2",
                   "/a 50 walk_0", "/a 55 walk_2", "/a 60 walk_0", "/a 70 walk_10"}));
  EXPECT_EQ(MessagesOf(*log, {.order = LogOrder::kStored}),
            (Lines{"/a 10 walk_1", "/a 30 walk_1", "/a 30 walk_1", "/a 20 walk_2", "/a 30 walk_2",
                   "/a 55 walk_2", "/a 50 walk_0", "/a 60 walk_0", "/a 70 walk_10"}))
      << "file by file, in the order of their first times";
  EXPECT_EQ(MessagesOf(*log, {.from_ns = 55, .to_ns = 60}),
            (Lines{"/a 55 walk_2", "/a 60 walk_0"}));
  EXPECT_EQ(MessagesOf(*log, {.topics = {{"/none"}}}), Lines{});
  EXPECT_EQ(ProblemsOf(*log), Lines{});
}

TEST_F(BagTest, MetadataStandsForTheBagItLiesIn) {
  Split("walk_0.db3", {1});
  WriteMetadata("walk_0.db3", 1);
  const fs::path before = fs::current_path();
  EXPECT_EQ(MessagesOf(*OpenLog(folder_ / "metadata.yaml")), Lines{"/a 1 walk_0"});
  fs::current_path(folder_);
  EXPECT_EQ(MessagesOf(*OpenLog("metadata.yaml")), Lines{"/a 1 walk_0"});
  EXPECT_EQ(MessagesOf(*OpenLog(".")), Lines{"/a 1 walk_0"});
  fs::current_path(before);
}

TEST_F(BagTest, AFileOfABagIsReadAlone) {
  Split("walk_0.db3", {1});
  Split("walk_1.db3", {2});
  const std::unique_ptr<LogSource> log = OpenLog(folder_ / "walk_1.db3");
  EXPECT_EQ(MessagesOf(*log), Lines{"/a 2 walk_1"});
}

TEST_F(BagTest, MetadataMayBeAbsentEmptyOrOfAnythingElse) {
  Split("walk_0.db3", {1});
  Split("walk_1.db3", {2});
  const Lines both = {"/a 1 walk_0", "/a 2 walk_1"};
  const std::unique_ptr<LogSource> without = OpenLog(folder_);
  EXPECT_EQ(MessagesOf(*without), both);
  EXPECT_EQ(ProblemsOf(*without), Lines{});
  for (const auto& [text, what] : std::vector<std::pair<std::string, std::string>>{
           {"", "metadata.yaml: is not used: has no rosbag2_bagfile_information"},
           {"{", "metadata.yaml: is not used: "},
           {"robot: go2", "metadata.yaml: is not used: has no rosbag2_bagfile_information"}}) {
    Write("metadata.yaml", text);
    const std::unique_ptr<LogSource> log = OpenLog(folder_);
    EXPECT_EQ(MessagesOf(*log), both);
    ASSERT_EQ(ProblemsOf(*log).size(), 1u);
    EXPECT_TRUE(ProblemsOf(*log)[0].starts_with(what)) << ProblemsOf(*log)[0];
    EXPECT_FALSE(LosesData(log->problems()));
  }
}

TEST_F(BagTest, TheFilesDecideAndWrongMetadataIsOdd) {
  Split("walk_0.db3", {1, 2});
  WriteMetadata("walk_0.db3", 5,
                "  starting_time: {nanoseconds_since_epoch: 1000000001}\n"
                "  duration: {nanoseconds: 1}\n");
  const std::unique_ptr<LogSource> log = OpenLog(folder_);
  EXPECT_EQ(MessagesOf(*log), (Lines{"/a 1 walk_0", "/a 2 walk_0"}));
  EXPECT_EQ(ProblemsOf(*log),
            (Lines{"metadata.yaml: counts 5 messages, the files have 2",
                   "metadata.yaml: is wrong about /a (2, not 5)",
                   "metadata.yaml: has other times: it begins +1.000 s and ends +1.000 s from the "
                   "files' messages"}));
  EXPECT_FALSE(LosesData(log->problems()));
}

/// Folders are renamed, and older recorders wrote the folder's name.
TEST_F(BagTest, BothSpellingsOfPathsAreUnderstood) {
  Split("walk_0.db3", {1});
  for (const char* spelling :
       {"walk_0.db3", "walk/walk_0.db3", "other/walk_0.db3", "walk_0.db3.zstd", "./walk_0.db3"}) {
    WriteMetadata(spelling, 1);
    const std::unique_ptr<LogSource> log = OpenLog(folder_);
    EXPECT_EQ(MessagesOf(*log), Lines{"/a 1 walk_0"}) << spelling;
    EXPECT_EQ(ProblemsOf(*log), Lines{}) << spelling;
  }
}

TEST_F(BagTest, WhatMetadataDoesNotNameIsReadIfItIsASplit) {
  Split("walk_0.db3", {1});
  Split("walk_1.db3", {2});
  Split("backup.db3", {3});
  WriteMetadata("walk_0.db3, walk_2.db3", 2);
  const std::unique_ptr<LogSource> log = OpenLog(folder_);
  EXPECT_EQ(MessagesOf(*log), (Lines{"/a 1 walk_0", "/a 2 walk_1"}));
  EXPECT_EQ(ProblemsOf(*log),
            (Lines{"metadata.yaml: names files that are not there: walk_2.db3",
                   "metadata.yaml: does not name backup.db3, which was left alone",
                   "metadata.yaml: does not name walk_1.db3, which was read, too"}));
  EXPECT_TRUE(LosesData(log->problems()));
  WriteMetadata("before_it_was_renamed.db3", 3);
  const std::unique_ptr<LogSource> renamed = OpenLog(folder_);
  EXPECT_EQ(MessagesOf(*renamed).size(), 3u);
  EXPECT_FALSE(LosesData(renamed->problems()));
}

TEST_F(BagTest, PackedFilesAreReadWhateverMetadataSays) {
  for (const bool says_size : {true, false}) {
    Split("walk_0.db3", {1});
    Pack("walk_0.db3", says_size);
    Split("walk_1.db3", {2});  // the recorder did not come to pack its last
    for (const char* files : {"walk_0.db3.zstd, walk_1.db3.zstd", "walk_0.db3, walk_1.db3",
                              "walk/walk_0.db3.zstd, walk/walk_1.db3"}) {
      WriteMetadata(files, 2, "  compression_format: \"\"\n  compression_mode: FILE\n");
      const std::unique_ptr<LogSource> log = OpenLog(folder_);
      EXPECT_EQ(MessagesOf(*log), (Lines{"/a 1 walk_0", "/a 2 walk_1"}));
      EXPECT_EQ(ProblemsOf(*log), Lines{});
    }
    EXPECT_EQ(MessagesOf(*OpenLog(folder_ / "walk_0.db3.zstd")), Lines{"/a 1 walk_0"});
  }
}

/// A player unpacks into the bag's folder.
TEST_F(BagTest, APackedFileBesideItsContentIsNotReadTwice) {
  Split("walk_0.db3", {1});
  const std::string plain = core::ReadText(folder_ / "walk_0.db3");
  Pack("walk_0.db3");
  Write("walk_0.db3", plain);
  EXPECT_EQ(MessagesOf(*OpenLog(folder_)), Lines{"/a 1 walk_0"});
  WriteMetadata("walk_0.db3.zstd", 1);
  EXPECT_EQ(MessagesOf(*OpenLog(folder_)), Lines{"/a 1 walk_0"});
}

TEST_F(BagTest, CutFramesGiveWhatComesOut) {
  {
    Db3File file(folder_ / "walk_0.db3", Db3Era::kQos);
    file.AddTopic(1, "/a", "pkg/msg/A");
    file.Run("BEGIN");
    for (int i = 0; i < 20000; ++i)
      file.AddMessage(1, i, std::to_string(i * 7919) + std::to_string(i * 104729));
    file.Run("COMMIT");
  }
  Pack("walk_0.db3", false, 0.7);
  const std::unique_ptr<LogSource> log = OpenLog(folder_);
  const std::size_t count = CountMessages(*log);
  EXPECT_GT(count, 8000u);
  EXPECT_LT(count, 16000u);
  EXPECT_EQ(log->contents().channels.at(0).message_count, count);
  const Lines problems = ProblemsOf(*log);
  ASSERT_EQ(problems.size(), 3u);
  EXPECT_TRUE(problems[0].starts_with("walk_0.db3.zstd: its zstd frame is cut; ")) << problems[0];
  EXPECT_TRUE(problems[1].starts_with("walk_0.db3.zstd: cut off: ")) << problems[1];
  EXPECT_TRUE(problems[2].starts_with("walk_0.db3.zstd: nothing can be read from row "));
}

TEST_F(BagTest, NothingIsLeftInTheTemporaryFolder) {
  const test::TemporaryFolder temporary;
  const std::string before = std::getenv("TMPDIR") == nullptr ? "" : std::getenv("TMPDIR");
  setenv("TMPDIR", temporary.path().c_str(), 1);
  Split("walk_0.db3", {1});
  Pack("walk_0.db3");
  {
    const std::unique_ptr<LogSource> log = OpenLog(folder_);
    EXPECT_TRUE(fs::is_empty(temporary.path())) << "not even while it is open";
    EXPECT_EQ(MessagesOf(*log), Lines{"/a 1 walk_0"});
  }
  EXPECT_TRUE(fs::is_empty(temporary.path()));
  setenv("TMPDIR", "/none", 1);
  EXPECT_NE(OpenError().find("TMPDIR: cannot use the temporary folder"), std::string::npos)
      << OpenError();
  before.empty() ? unsetenv("TMPDIR") : setenv("TMPDIR", before.c_str(), 1);
}

/// It says so itself, and is refused before it is unpacked.
TEST_F(BagTest, AFileThatGrowsWithoutBoundIsRefused) {
  Write("walk_0.db3.zstd", test::ZstdBomb((std::uint64_t{1} << 30) + 1, true));
  const std::string error = OpenError();
  EXPECT_TRUE(error.starts_with("BAG/walk_0.db3.zstd: ")) << error;
  EXPECT_NE(error.find(" bytes unpack to more than 1073741824: this is no log"), std::string::npos);
}

TEST_F(BagTest, McapFilesAreOneBagToo) {
  const std::string definitions =
      test::McapSchema(1, "pkg/msg/A", "ros2msg", "int8 a") + test::McapChannel(1, 1, "/a", "cdr");
  Write("walk_0.mcap", test::McapFile(definitions + test::McapMessage(1, 10, "x") +
                                      test::McapMessage(1, 30, test::Zstd("packed", false))));
  Write("walk_1.mcap.zstd",
        test::Zstd(test::McapFile(definitions + test::McapMessage(1, 20, "y") +
                                  test::McapMetadata("note") + test::McapAttachment("n", "text")),
                   false));
  WriteMetadata("walk_0.mcap, walk_1.mcap", 3);
  const std::unique_ptr<LogSource> log = OpenLog(folder_);
  EXPECT_EQ(log->contents().format, "an MCAP log in 2 files");
  EXPECT_EQ(MessagesOf(*log), (Lines{"/a 10 x", "/a 20 y", "/a 30 packed"}));
  ASSERT_EQ(log->contents().channels.size(), 1u);
  EXPECT_EQ(log->contents().channels[0].message_count, 3u);
  EXPECT_EQ(log->contents().attachments, Lines{"n"});
  EXPECT_EQ(log->ReadAttachment("n")->data.size(), 4u);
  EXPECT_FALSE(log->ReadAttachment("m"));
  EXPECT_TRUE(log->contents().metadata.contains("note"));
  EXPECT_EQ(ProblemsOf(*log), Lines{});
}

/// Topics may change their type from split to split, and a file may have two channels on a topic.
TEST_F(BagTest, ChannelsThatDifferStayApart) {
  const auto file = [](const std::string& text, std::uint64_t time_ns) {
    return test::McapFile(test::McapSchema(1, "pkg/msg/A", "ros2msg", text) +
                          test::McapChannel(1, 1, "/a", "cdr") +
                          test::McapChannel(2, 1, "/a", "cdr") +
                          test::McapMessage(1, time_ns, "x") + test::McapMessage(2, time_ns, "y"));
  };
  Write("walk_0.mcap", file("int8 a", 1));
  Write("walk_1.mcap", file("int8 a", 2));
  Write("walk_2.mcap", file("int16 a", 3));
  const std::unique_ptr<LogSource> log = OpenLog(folder_);
  ASSERT_EQ(log->contents().channels.size(), 4u);
  std::vector<std::size_t> channels;
  log->ForEach({}, [&](const LogMessage& m) {
    channels.push_back(m.channel_index);
    EXPECT_EQ(&m.channel, &log->contents().channels[m.channel_index]);
  });
  EXPECT_EQ(channels, (std::vector<std::size_t>{0, 1, 0, 1, 2, 3}));
}

TEST_F(BagTest, ProblemsOfPartsAreTheBags) {
  Split("walk_0.db3", {1});
  Write("walk_1.db3", "no database");
  const std::unique_ptr<LogSource> log = OpenLog(folder_);
  EXPECT_EQ(ProblemsOf(*log), Lines{"walk_1.db3: is not a log that scoria reads"});
  EXPECT_TRUE(LosesData(log->problems()));
  Split("walk_2.db3", {2});
  test::RunSql(folder_ / "walk_2.db3", "UPDATE messages SET data = x'28B52FFD00'");
  const std::unique_ptr<LogSource> read = OpenLog(folder_);
  EXPECT_EQ(MessagesOf(*read), Lines{"/a 1 walk_0"});
  EXPECT_EQ(ProblemsOf(*read).back(),
            "walk_2.db3: messages of /a are lost: they do not decompress");
}

TEST_F(BagTest, FoldersWithoutABagSayWhatTheyHold) {
  EXPECT_EQ(OpenError(),
            "BAG: is a folder without a log (no .db3 or .mcap file, packed by zstd or "
            "not); it holds nothing");
  WriteMetadata("walk_0.db3", 1);
  Write("a.csv", "t");
  Write("b.csv", "t");
  Write("README", "t");
  fs::create_directory(folder_ / "more");
  EXPECT_EQ(OpenError(),
            "BAG: is a folder without a log (no .db3 or .mcap file, packed by zstd or "
            "not); it holds 2 .csv, 1 .yaml, 1 folders, 1 without extension");
  Write("walk_0.db3", "x");
  EXPECT_EQ(OpenError(), "BAG/walk_0.db3: is not a log that scoria reads");
  Write("walk_1.db3", "");
  EXPECT_EQ(OpenError(),
            "BAG: none of its files can be read (BAG/metadata.yaml: does not name walk_1.db3, "
            "which was read, too; BAG/walk_0.db3: is not a log that scoria reads; "
            "BAG/walk_1.db3: is empty)");
}

TEST_F(BagTest, TwoKindsOfFilesAreNoBagUnlessMetadataSaysWhich) {
  Split("walk.db3", {1});
  Write("walk.mcap", test::McapFile(""));
  EXPECT_EQ(OpenError(),
            "BAG: holds walk.db3 and walk.mcap, and no metadata.yaml that says which "
            "are the bag; give one of the files");
  WriteMetadata("walk.db3", 1);
  EXPECT_EQ(MessagesOf(*OpenLog(folder_)), Lines{"/a 1 walk"});
}

}  // namespace
}  // namespace scoria::logs
