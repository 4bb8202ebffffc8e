// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/open_log.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/support/mcap_file.h"
#include "tests/support/robots.h"

namespace scoria::logs {
namespace {

namespace fs = std::filesystem;

/// What OpenLog says of a file of this content, without the folder.
std::string ErrorOf(const std::string& content) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "a.mcap", std::ios::binary) << content;
  try {
    (void)OpenLog(folder.path() / "a.mcap");
  } catch (const std::runtime_error& e) {
    return std::string(e.what()).substr(folder.path().string().size() + 1);
  }
  return "";
}

TEST(OpenLog, GoesByContentNotByName) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "a.db3";
  std::ofstream(path, std::ios::binary)
      << test::McapFile(test::McapChannel(1, 0, "/a", "json") + test::McapMessage(1, 1, "{}"));
  EXPECT_EQ(OpenLog(path)->contents().format, "an MCAP log");
}

TEST(OpenLog, SaysWhatElseAFileIs) {
  EXPECT_EQ(ErrorOf(""), "a.mcap: is empty");
  EXPECT_EQ(ErrorOf("Dear reader,\nthis is a letter.\n"), "a.mcap: is not a log that scoria reads");
  EXPECT_EQ(ErrorOf("\x89PNG\r\n"),
            "a.mcap: is a PNG image, not a log that scoria reads (a terrain names it: heightmap: "
            "{file: NAME.png})");
}

TEST(OpenLog, SaysHowLogsOfOthersAreConverted) {
  using namespace std::string_literals;
  const std::string no = ", not a log that scoria reads (";
  EXPECT_EQ(ErrorOf("#ROSBAG V2.0\n"),
            "a.mcap: is a ROS 1 bag" + no + "convert: rosbags-convert --src IN.bag --dst OUT)");
  EXPECT_EQ(ErrorOf("\x89HDF\r\n\x1a\n"s),
            "a.mcap: is an HDF5 file" + no + "write its series as CSV, say with h5py and pandas)");
  EXPECT_EQ(ErrorOf("ULog\x01\x12\x35\x01"s + std::string(8, '\0')),
            "a.mcap: is a PX4 ULog" + no + "convert: ulog2csv IN.ulg)");
  EXPECT_EQ(
      ErrorOf("\xa3\x95\x80\x80\x59"s),
      "a.mcap: is an ArduPilot log" + no + "convert: mavlogdump.py --format csv --types T IN.bin)");
  EXPECT_EQ(ErrorOf("MATLAB 5.0 MAT-file, Platform: GLNXA64"),
            "a.mcap: is a MATLAB file" + no + "write its series as CSV: writematrix)");
  EXPECT_EQ(ErrorOf("\x93NUMPY\x01\x00"s),
            "a.mcap: is a NumPy array" + no + "write it as CSV: numpy.savetxt)");
  EXPECT_EQ(ErrorOf("PAR1\x15\x04"), "a.mcap: is a Parquet file" + no +
                                         "write it as CSV: pandas.read_parquet(IN).to_csv(OUT))");
  EXPECT_EQ(ErrorOf("\x1f\x8b\x08"), "a.mcap: is a gzip archive" + no + "unpack it first)");
}

TEST(OpenLog, SaysWhyItCannot) {
  const test::TemporaryFolder folder;
  const fs::path none = folder.path() / "none";
  try {
    (void)OpenLog(none);
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(e.what(), none.string() + ": cannot read the file: no such file or directory");
  }
}

}  // namespace
}  // namespace scoria::logs
