// SPDX-License-Identifier: BSD-3-Clause
// Bags of recorders that were killed, and damaged ones: what can be read is read, the rest is
// named, and the user's files stay as they are.
#include <cstdlib>
#include <fstream>
#include <map>

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

constexpr int kMessages = 1000;
constexpr std::size_t kPage = 4096;

class DamagedDb3Test : public testing::Test {
 protected:
  /// A bag of 1000 messages of some 100 bytes, open.
  static std::unique_ptr<Db3File> Record(const fs::path& path, const std::string& pragma = "") {
    auto file = std::make_unique<Db3File>(path, Db3Era::kQos);
    if (!pragma.empty()) file->Run(pragma);
    file->AddTopic(1, "/a", "pkg/msg/A");
    for (int i = 0; i < kMessages; ++i)
      file->AddMessage(1, 1'000'000 * i, std::to_string(i) + std::string(100, 'x'));
    return file;
  }

  /// Bytes of all files of a folder.
  static std::map<std::string, std::string> FilesOf(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
      files[entry.path().filename()] = core::ReadText(entry.path());
    return files;
  }

  /// The numbers of the messages that are read, in order.
  std::vector<int> Read(const fs::path& path) {
    const std::map<std::string, std::string> before = FilesOf(path.parent_path());
    std::vector<int> numbers;
    const std::unique_ptr<LogSource> log = OpenLog(path);
    log->ForEach({}, [&](const LogMessage& m) {
      numbers.push_back(static_cast<int>(m.log_time_ns / 1'000'000));
      EXPECT_EQ(std::atoi(reinterpret_cast<const char*>(m.data.data())), numbers.back());
    });
    const auto& channels = log->contents().channels;
    EXPECT_EQ(*channels.at(0).message_count, numbers.size());
    problems_ = ProblemsOf(*log);
    loses_ = LosesData(log->problems());
    EXPECT_EQ(FilesOf(path.parent_path()), before);
    return numbers;
  }
  static std::vector<int> AllBut(int first, int last) {
    std::vector<int> numbers;
    for (int i = 0; i < kMessages; ++i) {
      if (i < first || i > last) numbers.push_back(i);
    }
    return numbers;
  }

  test::TemporaryFolder folder_, copies_;
  fs::path path_ = folder_.path() / "a.db3", copy_ = copies_.path() / "a.db3";
  Lines problems_;
  bool loses_ = false;
};

TEST_F(DamagedDb3Test, LiveWalIsReadWithItsDatabase) {
  const auto file = Record(path_, "PRAGMA journal_mode = WAL; PRAGMA wal_autocheckpoint = 0");
  for (const char* suffix : {"", "-wal"})  // as a killed recorder leaves them
    fs::copy_file(path_.string() + suffix, copy_.string() + suffix);
  EXPECT_EQ(Read(copy_), AllBut(-1, -1));
  EXPECT_EQ(problems_, Lines{"a.db3: was not closed; what a.db3-wal holds was read with it"});
  EXPECT_FALSE(loses_);
  EXPECT_EQ(Read(path_), AllBut(-1, -1)) << "while the recorder is at work";
  fs::resize_file(copy_.string() + "-wal", fs::file_size(copy_.string() + "-wal") / 2);
  const std::size_t half = Read(copy_).size();
  EXPECT_GT(half, 300u);
  EXPECT_LT(half, 700u);
}

/// Without a -wal the database is read as it is, and a stale -shm beside it is left alone.
TEST_F(DamagedDb3Test, EmptyWalIsNone) {
  Record(path_, "PRAGMA journal_mode = WAL").reset();
  fs::copy_file(path_, copy_);
  std::ofstream(copy_.string() + "-wal").close();
  std::ofstream(copy_.string() + "-shm") << std::string(32768, 's');
  EXPECT_EQ(Read(copy_), AllBut(-1, -1));
  EXPECT_EQ(problems_, Lines{});
}

TEST_F(DamagedDb3Test, HotJournalIsRolledBackInACopy) {
  const auto file = Record(path_, "PRAGMA journal_mode = DELETE");
  file->Run("PRAGMA cache_size = 5");  // so that changed pages reach the file before their end
  file->Run("BEGIN");
  file->Run("UPDATE messages SET timestamp = timestamp + 7, data = 'changed'");
  for (const char* suffix : {"", "-journal"})
    fs::copy_file(path_.string() + suffix, copy_.string() + suffix);
  ASSERT_NE(core::ReadText(copy_).find("changed"), std::string::npos);
  EXPECT_EQ(Read(copy_), AllBut(-1, -1));
  EXPECT_EQ(problems_, Lines{"a.db3: was not closed; the transaction that a.db3-journal tells of "
                             "did not end and was undone, in a copy"});
  EXPECT_FALSE(loses_);
}

TEST_F(DamagedDb3Test, CutAnywhereItReadsTheRowsThatAreThere) {
  Record(path_).reset();
  const std::size_t pages = fs::file_size(path_) / kPage;
  std::size_t last = 0;
  for (std::size_t kept = 6; kept < pages; ++kept) {
    fs::copy_file(path_, copy_, fs::copy_options::overwrite_existing);
    fs::resize_file(copy_, kept * kPage + 1000);
    const std::vector<int> numbers = Read(copy_);
    ASSERT_EQ(numbers, AllBut(static_cast<int>(numbers.size()), kMessages));
    ASSERT_GE(numbers.size(), last);
    ASSERT_TRUE(numbers.size() == kMessages || loses_);
    ASSERT_FALSE(problems_.empty());
    ASSERT_EQ(problems_[0],
              fmt::format("a.db3: cut off: {} of its {} pages are there", kept, pages));
    last = numbers.size();
  }
  EXPECT_GT(last, 900u);
}

TEST_F(DamagedDb3Test, CutSaysHowManyMessagesAndUpToWhen) {
  Record(path_).reset();
  fs::resize_file(path_, fs::file_size(path_) * 6 / 10);
  const std::vector<int> numbers = Read(path_);
  ASSERT_EQ(problems_.size(), 2u);
  EXPECT_EQ(problems_[1],
            fmt::format("a.db3: nothing can be read from row {} on (database disk image is "
                        "malformed); {} messages are there, the last {:.3f} s after the first",
                        numbers.size() + 1, numbers.size(), 0.001 * numbers.back()));
}

/// Some messages are longer than a page; what lies on the others may be gone.
TEST_F(DamagedDb3Test, RowsWithoutAllTheirBytesAreNotCounted) {
  {
    Db3File file(path_, Db3Era::kQos);
    file.AddTopic(1, "/a", "pkg/msg/A");
    for (int i = 0; i < 100; ++i)
      file.AddMessage(1, 1'000'000 * i, std::to_string(i) + std::string(3 * kPage, 'x'));
  }
  fs::resize_file(path_, fs::file_size(path_) / 2);
  const std::vector<int> numbers = Read(path_);
  EXPECT_GT(numbers.size(), 40u);
  EXPECT_LT(numbers.size(), 60u);
  EXPECT_TRUE(loses_);
}

TEST_F(DamagedDb3Test, DamagedPageIsPassedOver) {
  Record(path_).reset();
  std::string bytes = core::ReadText(path_);
  const std::size_t page = bytes.find("500xxx") / kPage * kPage;
  bytes[page] = 'Z';  // no kind of page
  std::ofstream(path_, std::ios::binary) << bytes;
  const std::vector<int> numbers = Read(path_);
  EXPECT_GT(numbers.size(), 950u);
  EXPECT_EQ(numbers.back(), kMessages - 1);
  const auto gap =
      std::adjacent_find(numbers.begin(), numbers.end(), [](int a, int b) { return b != a + 1; });
  ASSERT_NE(gap, numbers.end());
  EXPECT_LE(*gap, 499);
  EXPECT_GE(*(gap + 1), 501);
  EXPECT_EQ(numbers, AllBut(*gap + 1, *(gap + 1) - 1)) << "one gap";
  EXPECT_EQ(problems_, Lines{fmt::format("a.db3: rows {} to {} cannot be read (database disk image "
                                         "is malformed)",
                                         *gap + 2, *(gap + 1))});
}

/// All pages of the tree in one another's place: no endless walk, no row twice.
TEST_F(DamagedDb3Test, PagesInACircleComeToAnEnd) {
  Record(path_).reset();
  const std::string whole = core::ReadText(path_);
  const std::size_t pages = whole.size() / kPage;
  for (std::size_t to = 2; to < pages; ++to) {
    std::string bytes = whole;
    bytes.replace(to * kPage, kPage, whole, 4 * kPage, kPage);
    std::ofstream(copy_, std::ios::binary) << bytes;
    try {
      const std::unique_ptr<LogSource> log = OpenLog(copy_);
      EXPECT_LE(CountMessages(*log), static_cast<std::size_t>(kMessages));
    } catch (const std::runtime_error&) {  // the table of topics was among them
    }
  }
}

TEST_F(DamagedDb3Test, RealBagCutAtSixtyPercentGivesItsRows) {
  const char* data = std::getenv("SCORIA_REFERENCE_DATA");
  if (data == nullptr) GTEST_SKIP() << "SCORIA_REFERENCE_DATA is not set";
  const fs::path bag = fs::path(data) / "logs/go2_vicon_orl/test_6_vicon_bag";
  fs::copy_file(bag / "rosbag2_2025_12_05-14_46_48_0.db3", path_);
  fs::permissions(path_, fs::perms::owner_write, fs::perm_options::add);
  fs::resize_file(path_, 154 * kPage);
  const std::unique_ptr<LogSource> log = OpenLog(path_);
  const std::size_t count = CountMessages(*log);
  EXPECT_GE(count, 4385u);
  EXPECT_EQ(log->contents().channels.at(0).message_count, count);
  EXPECT_EQ(ProblemsOf(*log).at(0), "a.db3: cut off: 154 of its 257 pages are there");
}

}  // namespace
}  // namespace scoria::logs
