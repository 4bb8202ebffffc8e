// SPDX-License-Identifier: BSD-3-Clause
// Damaged MCAP files: what can be read is read, what is lost is named.
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/files.h"
#include "core/rng.h"
#include "logs/format/mcap_writer.h"
#include "logs/format/open_log.h"
#include "tests/support/mcap_file.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

constexpr int kWritten = 100;

class DamagedMcapTest : public testing::Test {
 protected:
  DamagedMcapTest() {
    {
      McapWriter writer(path_, 1000);
      const auto channel = writer.AddChannel("/a", "pkg/msg/A", "int8 a");
      for (int i = 0; i < kWritten; ++i) {
        Bytes data(static_cast<std::size_t>(30 + i % 40));
        for (std::byte& b : data) b = static_cast<std::byte>(i * i);  // does not pack to nothing
        writer.Write(channel, 10'000'000 * i, data);
      }
    }
    whole_ = core::ReadText(path_);
    for (std::size_t at = whole_.find("zstd"); at != std::string::npos;
         at = whole_.find("zstd", at + 1))
      words_.push_back(at);
  }

  /// Reads a file of these bytes. @returns the times of its messages, in steps.
  std::vector<int> Read(const std::string& bytes) {
    std::ofstream(path_, std::ios::binary) << bytes;
    std::vector<int> steps;
    const std::unique_ptr<LogSource> log = OpenLog(path_);
    log->ForEach({}, [&](const LogMessage& m) {
      steps.push_back(static_cast<int>(m.log_time_ns / 10'000'000));
    });
    problems_ = log->problems();
    counted_ = log->contents().channels.empty() ? 0 : *log->contents().channels[0].message_count;
    return steps;
  }

  test::TemporaryFolder folder_;
  fs::path path_ = folder_.path() / "a.mcap";
  std::string whole_;
  std::vector<std::size_t> words_;  // "zstd" of every chunk, then of the summary
  std::vector<LogProblem> problems_;
  std::uint64_t counted_ = 0;
};

TEST_F(DamagedMcapTest, CutAnywhereItReadsToTheLastWholeMessageThatIsThere) {
  std::size_t last = 0;
  for (std::size_t size = 8; size < whole_.size(); size += 3) {
    const std::vector<int> steps = Read(whole_.substr(0, size));
    for (std::size_t i = 0; i < steps.size(); ++i) ASSERT_EQ(steps[i], static_cast<int>(i));
    ASSERT_GE(steps.size(), last) << "cut at " << size;  // more bytes never mean fewer messages
    last = steps.size();
    ASSERT_EQ(counted_, steps.size()) << "cut at " << size;
    const bool said = problems_.size() == 1 && problems_[0].kind == LogProblem::Kind::kCut &&
                      problems_[0].what.starts_with("cut off at byte ");
    ASSERT_TRUE(said || (steps.size() == kWritten && problems_.empty())) << "cut at " << size;
  }
  EXPECT_EQ(last, static_cast<std::size_t>(kWritten));
}

TEST_F(DamagedMcapTest, CutChunkGivesItsFirstMessages) {
  core::Rng rng(1, 0, core::Stream::kSensor);
  std::string inner = test::McapChannel(1, 0, "/a", "");
  for (std::uint64_t i = 0; i < 20; ++i) {
    std::string data(100'000, '\0');
    for (char& c : data) c = static_cast<char>(rng.NextU32());
    inner += test::McapMessage(1, 10'000'000 * i, data);
  }
  for (const test::McapChunk& chunk :
       {test::ToChunk(inner, 0, 190'000'000), test::ToPackedChunk(inner, 0, 190'000'000),
        test::ToPackedChunk(inner, 0, 190'000'000, "lz4")}) {
    const std::string file = test::McapFile(chunk.ToRecord());
    const std::vector<int> steps = Read(file.substr(0, file.size() * 7 / 10));
    EXPECT_GT(steps.size(), 10u) << chunk.compression;
    EXPECT_LT(steps.size(), 20u);
    ASSERT_EQ(problems_.size(), 1u);
    EXPECT_EQ(problems_[0].kind, LogProblem::Kind::kCut);
    EXPECT_EQ(problems_[0].what,
              fmt::format("cut off at byte {}; everything before it was read, and {} messages of "
                          "the chunk there",
                          8 + 9 + 8, steps.size()));
  }
}

TEST_F(DamagedMcapTest, GoesOnAfterABadChunkOfAnyCompression) {
  for (const char* compression : {"zstd", "lz4"}) {
    std::string records = test::McapChannel(1, 0, "/a", "");
    for (std::uint64_t chunk = 0; chunk < 5; ++chunk) {
      std::string inner;
      for (std::uint64_t i = 10 * chunk; i < 10 * chunk + 10; ++i)
        inner += test::McapMessage(1, 10'000'000 * i, "message " + std::to_string(i * i));
      test::McapChunk packed = test::ToPackedChunk(inner, 100'000'000 * chunk,
                                                   100'000'000 * chunk + 90'000'000, compression);
      if (chunk == 1) packed.packed[packed.packed.size() / 2] ^= 0x55;
      packed.crc = test::Crc32(inner);
      records += packed.ToRecord();
    }
    const std::vector<int> steps = Read(test::McapFile(records));
    EXPECT_EQ(steps.size(), 40u) << compression;
    EXPECT_EQ(steps.back(), 49);
    EXPECT_EQ(problems_.size(), 1u);
    EXPECT_TRUE(LosesData(problems_));
  }
}

TEST_F(DamagedMcapTest, ZerosAtTheEndAreACut) {
  const std::size_t end = words_[3] - 9 - 8 - 8 - 8 - 4 - 4;  // where the fourth chunk begins
  const std::size_t before = Read(whole_.substr(0, end)).size();
  const std::vector<LogProblem> problems = problems_;
  EXPECT_EQ(Read(whole_.substr(0, end) + std::string(5000, '\0')).size(), before);
  EXPECT_EQ(problems_, problems);
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_EQ(problems_[0].what,
            fmt::format("cut off at byte {}; everything before it was read", end));
}

TEST_F(DamagedMcapTest, GoesOnAfterABadChunk) {
  std::string bytes = whole_;
  bytes[words_[1] + 40] ^= 0x55;
  const std::vector<int> with_summary = Read(bytes);
  ASSERT_EQ(problems_.size(), 1u);
  const int lost = kWritten - static_cast<int>(with_summary.size());
  EXPECT_EQ(problems_[0].kind, LogProblem::Kind::kLost);
  const std::size_t chunk = words_[1] - 9 - 8 - 8 - 8 - 4 - 4;
  const int first = static_cast<int>(std::adjacent_find(with_summary.begin(), with_summary.end(),
                                                        [](int a, int b) { return b != a + 1; }) -
                                     with_summary.begin() + 1);
  const bool unpacks = problems_[0].what.find("checksum") != std::string::npos;
  EXPECT_EQ(problems_[0].what,
            fmt::format("at byte {}: chunk {}; {} messages are lost, {:.3f} s to {:.3f} s after "
                        "the log's first",
                        chunk, unpacks ? "has a wrong checksum" : "does not decompress", lost,
                        0.01 * first, 0.01 * (first + lost - 1)));
  // The same without the summary, by the message indexes.
  EXPECT_EQ(Read(bytes.substr(0, bytes.size() - 20)), with_summary);
  EXPECT_EQ(problems_.size(), 1u);
}

TEST_F(DamagedMcapTest, SummaryFindsWhatStandsBehindABrokenRecord) {
  std::string bytes = whole_;
  const std::size_t length = words_[1] - 8 - 8 - 8 - 4 - 4 - 8;
  bytes[length + 6] = '\x7f';
  const std::vector<int> steps = Read(bytes);
  EXPECT_EQ(steps.size(), static_cast<std::size_t>(kWritten)) << "its length is in the index";
  bytes[length - 1] = '\x77';  // no chunk at all
  EXPECT_EQ(Read(bytes).back(), kWritten - 1);
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_NE(problems_[0].what.find("no chunk is where the index says; "), std::string::npos)
      << problems_[0].what;
}

TEST_F(DamagedMcapTest, DamagedSummaryIsDoneWithout) {
  std::string bytes = whole_;
  bytes[words_.back()] ^= 1;
  EXPECT_EQ(Read(bytes).size(), static_cast<std::size_t>(kWritten));
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_EQ(problems_[0].kind, LogProblem::Kind::kOdd);
  EXPECT_EQ(problems_[0].what,
            "the summary is damaged (wrong checksum); the file was read without it");
}

TEST_F(DamagedMcapTest, DamagedBeginningIsDoneWithout) {
  std::string bytes = whole_;
  bytes[0] = 'v';
  EXPECT_EQ(Read(bytes).size(), static_cast<std::size_t>(kWritten));
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_EQ(problems_[0].what, "its first bytes are damaged");
}

/// The size that a chunk claims is no reason to take memory.
TEST_F(DamagedMcapTest, ChunkThatClaimsTooMuchIsRefused) {
  const std::size_t chunk = words_[0] - 4 - 4 - 8;  // before: length of the word, checksum
  for (const auto& [size, what] : std::vector<std::pair<std::uint64_t, std::string>>{
           {1 << 13, "chunk has a wrong size"},
           {1 << 27, "chunk has a wrong size"},
           {1ull << 40, "chunk claims more than 256 MiB"},
           {~0ull, "chunk claims more than 256 MiB"}}) {
    std::string bytes = whole_;
    bytes.replace(chunk, 8, test::Number(size, 8));
    EXPECT_LT(Read(bytes).size(), static_cast<std::size_t>(kWritten));
    ASSERT_EQ(problems_.size(), 1u);
    EXPECT_NE(problems_[0].what.find(what), std::string::npos) << problems_[0].what;
  }
}

TEST_F(DamagedMcapTest, PackedSizeBeyondTheChunkIsRefused) {
  std::string bytes = whole_;
  bytes.replace(words_[0] + 4, 8, test::Number(1ull << 33, 8));
  EXPECT_GT(Read(bytes).size(), 50u);
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_NE(problems_[0].what.find("chunk has a wrong size; "), std::string::npos)
      << problems_[0].what;
}

TEST_F(DamagedMcapTest, RecordsThatClaimTooMuchTakeNoMemory) {
  const std::string definitions = test::McapChannel(1, 0, "/a", "");
  for (const std::uint64_t length : {1ull << 40, ~0ull}) {
    for (const int op : {0x03, 0x04, 0x05, 0x06, 0x07, 0x09, 0x0C}) {
      const std::string file =
          test::McapFile(definitions + test::McapMessage(1, 0, "x") +
                         test::Number(static_cast<std::uint64_t>(op), 1) + test::Number(length, 8));
      EXPECT_EQ(Read(file), std::vector<int>{0}) << op;
      EXPECT_EQ(problems_.size(), 1u);
    }
  }
  // Inner lengths, of strings, maps and lists.
  for (const int op : {0x03, 0x04, 0x07, 0x09, 0x0C}) {
    const std::string body = test::Number(1, 2) + test::Number(1, 2) + std::string(100, '\xff');
    const std::string file = test::McapFile(definitions + test::McapMessage(1, 0, "x") +
                                            test::McapRecord(static_cast<std::uint8_t>(op), body));
    EXPECT_EQ(Read(file), std::vector<int>{0}) << op;
  }
}

TEST_F(DamagedMcapTest, UnknownCompressionIsNamed) {
  test::McapChunk chunk = test::ToChunk(test::McapMessage(1, 0, "x"), 0, 0);
  chunk.compression = "br";
  EXPECT_EQ(Read(test::McapFile(test::McapChannel(1, 0, "/a", "") + test::McapMessage(1, 0, "y") +
                                chunk.ToRecord())),
            std::vector<int>{0});
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_NE(problems_[0].what.find(": unknown compression \"br\""), std::string::npos)
      << problems_[0].what;
}

/// Without a summary, channels are defined within chunks alone.
TEST_F(DamagedMcapTest, IndexedChunkIsUnpackedForTheChannelsItDefines) {
  const std::string inner = test::McapChannel(1, 0, "/a", "") + test::McapMessage(1, 0, "x");
  const std::size_t at = test::McapChannel(1, 0, "/a", "").size();
  const std::string indexed =
      test::ToPackedChunk(inner, 0, 0).ToRecord() + test::McapMessageIndex(1, {{0, at}});
  EXPECT_EQ(Read(test::McapFile(indexed)), std::vector<int>{0});
  EXPECT_EQ(problems_.size(), 0u);
  EXPECT_EQ(counted_, 1u);
}

TEST_F(DamagedMcapTest, DamagedMessageIndexLosesNothing) {
  const std::string inner = test::McapMessage(1, 0, "x") + test::McapMessage(1, 10'000'000, "y");
  const std::string broken = test::McapRecord(0x07, test::Number(1, 2) + test::Number(99, 4));
  EXPECT_EQ(Read(test::McapFile(test::McapChannel(1, 0, "/a", "") +
                                test::ToPackedChunk(inner, 0, 10'000'000).ToRecord() + broken)),
            (std::vector<int>{0, 1}));
  EXPECT_EQ(problems_, std::vector<LogProblem>{});
  EXPECT_EQ(counted_, 2u);
}

/// The first chunk defines the channels; where the indexes alone are left, they tell what is lost.
TEST_F(DamagedMcapTest, LostDefinitionsAreSaidWithTheirMessages) {
  const std::size_t last_chunk = words_[words_.size() / 2 - 1];  // the summary has as many words
  std::string bytes = whole_.substr(0, last_chunk - 20);
  bytes[words_[0] + 40] ^= 0x55;
  EXPECT_EQ(Read(bytes), std::vector<int>{});
  ASSERT_EQ(problems_.size(), 3u);
  EXPECT_EQ(problems_[0].kind, LogProblem::Kind::kCut);
  EXPECT_NE(problems_[1].what.find(" messages are lost, 0.000 s to "), std::string::npos)
      << problems_[1].what;
  EXPECT_EQ(problems_[2].what, "messages of channel 0 are lost: the file does not define it");
}

TEST_F(DamagedMcapTest, IndexThatIsWrongIsNamed) {
  const std::string definition = test::McapChannel(1, 0, "/a", "");
  const std::string chunk =
      test::ToPackedChunk(test::McapMessage(1, 0, "x") + test::McapMessage(1, 50'000'000, "y"), 0,
                          50'000'000)
          .ToRecord();
  using Entries = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
  for (const Entries& entries :
       {Entries{{0, 0}}, {{0, 0}, {40'000'000, 9}}, {{0, 0}, {0, 9}, {0, 9}}}) {
    EXPECT_EQ(Read(test::McapFile(definition + chunk + test::McapMessageIndex(1, entries))),
              (std::vector<int>{0, 5}));
    ASSERT_EQ(problems_.size(), 1u);
    EXPECT_EQ(problems_[0].kind, LogProblem::Kind::kOdd);
    EXPECT_EQ(problems_[0].what,
              fmt::format("at byte {}: the chunk's index is wrong about its 2 messages or their "
                          "times, so they may come out of their order",
                          8 + 9 + 8 + definition.size()));
  }
}

}  // namespace
}  // namespace scoria::logs
