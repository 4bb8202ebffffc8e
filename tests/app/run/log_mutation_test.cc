// SPDX-License-Identifier: BSD-3-Clause
// Damaged logs: whatever reads them ends in good order. With SCORIA_LONG_TESTS=1, 500 of them.
#include <cstdlib>

#include <gtest/gtest.h>

#include "core/files.h"
#include "core/rng.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

class Mutator {
 public:
  Mutator(std::string log, core::Rng rng) : log_(std::move(log)), rng_(rng) {
    constexpr std::size_t kMagic = 8, kHead = 9;
    for (std::size_t at = kMagic; at + kHead < log_.size();) {
      lengths_.push_back(at + 1);
      std::uint64_t length = 0;
      for (std::size_t i = kHead - 1; i > 0; --i)
        length = length << 8 | static_cast<unsigned char>(log_[at + i]);
      at += kHead + static_cast<std::size_t>(length);
    }
  }

  /// The log with one fault.
  [[nodiscard]] std::string Next() {
    std::string log = log_;
    const std::size_t at = Draw(log.size());
    switch (Draw(7)) {
      case 0:
        log[at] = Byte();
        break;
      case 1:
        for (std::size_t i = 0; i < 64; ++i) log[Draw(log.size())] = Byte();
        break;
      case 2:
        log.resize(at);
        break;
      case 3:
        log.insert(at, Noise(1 + Draw(5000)));
        break;
      case 4:
        log.erase(at, 1 + Draw(5000));
        break;
      case 5:  // the metadata, which no chunk's checksum covers
        log[Draw(std::min<std::size_t>(log.size(), 60000))] = Byte();
        break;
      default:  // the length of a record
        const std::size_t length = lengths_[Draw(lengths_.size())];
        for (std::size_t i = 0, n = 1 + Draw(8); i < n; ++i) log[length + i] = Byte();
    }
    return log;
  }

 private:
  std::size_t Draw(std::size_t below) { return rng_.NextU32() % below; }
  char Byte() { return static_cast<char>(rng_.NextU32()); }
  std::string Noise(std::size_t size) {
    std::string noise(size, '\0');
    for (char& c : noise) c = Byte();
    return noise;
  }

  std::string log_;
  core::Rng rng_;
  std::vector<std::size_t> lengths_;  // where records say theirs
};

TEST(DamagedLog, EveryReaderEndsInGoodOrder) {
  const test::TemporaryFolder folder;
  const fs::path run = folder.path() / "run", log = run / "log.mcap";
  ASSERT_EQ(
      test::RunScoria({"run", test::SourcePath("scenarios/flat.yaml").string(), "--set",
                       "duration_s=1", "--set", "start=standing", "--set", "terrain.size_m=6.4",
                       "--set", "terrain.resolution_m=0.1", "--out", run.string()})
          .code,
      0);
  const int count = std::getenv("SCORIA_LONG_TESTS") != nullptr ? 500 : 14;
  Mutator mutator(core::ReadText(log), core::Rng(14, 0, core::Stream::kSensor));
  const std::vector<std::vector<std::string>> commands = {
      {"replay", log.string()},
      {"verify", log.string()},
      {"report", run.string()},
      {"render", log.string(), "--size", "64x64", "--fps", "5", "--to", "0.4"}};
  constexpr long kGigabyte_kB = 1'000'000;
  for (int i = 0; i < count; ++i) {
    core::WriteText(log, mutator.Next());
    for (const std::vector<std::string>& command : commands) {
      const test::ProgramEnd end = test::RunScoria(command);
      const bool orderly = end.code >= 0 && end.code <= 2 && !end.hung;
      EXPECT_TRUE(orderly) << command[0] << " of mutation " << i << ": " << end.code << " "
                           << end.output;
      EXPECT_LT(end.peak_kB, kGigabyte_kB) << command[0] << " of mutation " << i;
      EXPECT_TRUE(end.code == 0 || command[0] != "report") << i << ": " << end.output;
      EXPECT_TRUE(end.code == 0 || !end.output.empty()) << command[0] << " of mutation " << i;
    }
  }
}

}  // namespace
}  // namespace scoria::app
