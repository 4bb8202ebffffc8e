// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/zstd_frames.h"

#include <fstream>

#include <gtest/gtest.h>

#include "core/files.h"
#include "tests/support/db3_file.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

class ZstdFile : public testing::Test {
 protected:
  std::string Unpack(const std::string& packed, std::uint64_t most = 1 << 30) {
    std::ofstream(in_, std::ios::binary) << packed;
    std::string problem = UnpackZstd(RandomAccessFile(in_), out_, most);
    content_ = core::ReadText(out_);
    return problem;
  }
  static std::string Content(std::size_t size) {
    std::string content(size, '\0');
    std::uint32_t state = 1;  // a random walk, so that it packs a little
    for (char& c : content) c = static_cast<char>((state = state * 1664525 + 1013904223) >> 26);
    return content;
  }

  test::TemporaryFolder folder_;
  fs::path in_ = folder_.path() / "in", out_ = folder_.path() / "out";
  std::string content_;
};

/// The sizes of what zstd takes in and gives out at a time are 128 KiB and a bit more.
TEST_F(ZstdFile, AnySizeComesOutWhole) {
  for (const std::size_t size : {0u, 1u, 131071u, 131072u, 131073u, 262144u, 1000000u}) {
    for (const bool says_size : {true, false}) {
      EXPECT_EQ(Unpack(test::Zstd(Content(size), says_size)), "") << size;
      EXPECT_EQ(content_, Content(size));
    }
  }
}

TEST_F(ZstdFile, SeveralFramesAreOneContent) {
  EXPECT_EQ(Unpack(test::Zstd("one, ", true) + test::Zstd("two", false)), "");
  EXPECT_EQ(content_, "one, two");
}

TEST_F(ZstdFile, CutAndDamagedFramesGiveWhatCameBefore) {
  const std::string packed = test::Zstd(Content(1000000), false);
  const std::string cut = Unpack(packed.substr(0, packed.size() * 7 / 10));
  EXPECT_EQ(cut, "its zstd frame is cut; " + std::to_string(content_.size()) + " bytes came out");
  EXPECT_GT(content_.size(), 200000u);
  EXPECT_TRUE(Content(1000000).starts_with(content_));
  const std::string rest = Unpack(packed + "no frame");
  EXPECT_TRUE(rest.starts_with("does not decompress behind byte ")) << rest;
  EXPECT_EQ(content_, Content(1000000));
}

TEST_F(ZstdFile, MoreThanTheMostIsRefused) {
  for (const bool says_size : {true, false}) {
    const std::string packed = test::ZstdBomb(1000000, says_size);
    EXPECT_EQ(Unpack(packed, 1000000), "");
    EXPECT_EQ(content_, std::string(1000000, '\0'));
    try {
      Unpack(packed, 999999);
      FAIL();
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(e.what(), in_.string() + ": " + std::to_string(packed.size()) +
                              " bytes unpack to more than 999999: this is no log");
    }
  }
  EXPECT_EQ(LargestUnpackedLog(10), std::uint64_t{1} << 30);
  EXPECT_EQ(LargestUnpackedLog(1 << 30), std::uint64_t{200} << 30);
}

TEST_F(ZstdFile, FullDisksAreSaid) {
  std::ofstream(in_, std::ios::binary) << test::Zstd(Content(1000000), true);
  try {
    (void)UnpackZstd(RandomAccessFile(in_), "/dev/full", 1 << 30);
    FAIL();
  } catch (const core::FileError& e) {
    EXPECT_STREQ(e.what(), "/dev/full: cannot write: no space left on device");
  }
}

}  // namespace
}  // namespace scoria::logs
