// SPDX-License-Identifier: BSD-3-Clause
// A log of 10 GB is listed and read in 1 GiB of memory. Its file is sparse: messages of zeros take
// no room on the disk, and are read like any other.
#include <fstream>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "logs/format/open_log.h"
#include "tests/support/mcap_file.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMemory = std::uint64_t{1} << 30, kFile = 10'000'000'000;
constexpr std::uint64_t kMessage = 1 << 20, kPerChunk = 8, kStep_ns = 1'000'000;

/// Chunks without compression, of zeros, with message indexes, and no summary.
class BigLog {
 public:
  explicit BigLog(const fs::path& path) : file_(path, std::ios::binary) {
    const std::string start = test::McapFile("");
    Put(start.substr(0, start.size() - kEnd));
    Put(test::McapChannel(1, 0, "/a", ""));
    while (static_cast<std::uint64_t>(file_.tellp()) < kFile) AddChunk();
    Put(start.substr(start.size() - kEnd));
  }
  [[nodiscard]] std::uint64_t messages() const { return messages_; }

 private:
  static constexpr std::size_t kEnd = (9 + 4) + (9 + 20) + 8;  // data end, footer, magic

  void Put(const std::string& bytes) {
    file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  void AddChunk() {
    const std::string message = test::McapMessage(1, 0, "");
    const std::uint64_t size = kPerChunk * (message.size() + kMessage);
    test::McapChunk chunk;
    chunk.first_ns = kStep_ns * messages_;
    chunk.last_ns = kStep_ns * (messages_ + kPerChunk - 1);
    chunk.unpacked_size = chunk.packed_size = size;
    std::string head = chunk.ToRecord();
    head.replace(1, 8, test::Number(head.size() - 9 + size, 8));
    Put(head);
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index;
    for (std::uint64_t i = 0; i < kPerChunk; ++i) {
      const std::uint64_t time_ns = kStep_ns * messages_++;
      index.emplace_back(time_ns, i * (message.size() + kMessage));
      std::string record = test::McapMessage(1, time_ns, "");
      record.replace(1, 8, test::Number(record.size() - 9 + kMessage, 8));
      Put(record);
      file_.seekp(static_cast<std::streamoff>(kMessage), std::ios::cur);
    }
    Put(test::McapMessageIndex(1, index));
  }

  std::ofstream file_;
  std::uint64_t messages_ = 0;
};

/// Whether `work` is true within that much memory of its own process.
template <class Work>
bool WithinMemory(std::uint64_t bytes, const Work& work) {
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{bytes, bytes};
    bool good = setrlimit(RLIMIT_AS, &limit) == 0;
    try {
      good = good && work();
    } catch (const std::exception&) {  // std::bad_alloc is the one that counts
      good = false;
    }
    _exit(good ? 0 : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(BigLog, OfTenGigabytesIsReadInOneOfMemory) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers take more address space themselves";
#endif
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "big.mcap";
  const std::uint64_t messages = BigLog(path).messages();
  ASSERT_GE(fs::file_size(path), kFile);
  EXPECT_FALSE(WithinMemory(kMemory, [] { return !Bytes(kMemory).empty(); })) << "the limit holds";
  EXPECT_TRUE(WithinMemory(kMemory, [&] {
    const std::unique_ptr<LogSource> log = OpenLog(path);
    const LogChannel& channel = log->contents().channels.at(0);
    std::uint64_t count = 0, bytes = 0;
    log->ForEach({}, [&](const LogMessage& m) {
      ++count;
      bytes += m.data.size();
    });
    return channel.message_count == messages && count == messages && bytes == messages * kMessage &&
           channel.span == LogSpan{0, static_cast<std::int64_t>(kStep_ns * (messages - 1))} &&
           log->problems().empty();
  }));
}

}  // namespace
}  // namespace scoria::logs
