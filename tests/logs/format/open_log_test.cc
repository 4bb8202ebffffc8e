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
  EXPECT_EQ(ErrorOf("time,q\n0,1\n"), "a.mcap: is not a log that scoria reads");
  EXPECT_EQ(ErrorOf("\x89PNG\r\n"),
            "a.mcap: is a PNG image, not a log (a terrain names it: heightmap: {file: NAME.png})");
  EXPECT_EQ(ErrorOf("#ROSBAG V2.0\n"), "a.mcap: is a ROS 1 bag, not a log");
}

TEST(OpenLog, SaysWhyItCannot) {
  const test::TemporaryFolder folder;
  const fs::path none = folder.path() / "none";
  for (const auto& [path, what] :
       {std::pair{none, ": cannot read the file: no such file or directory"},
        {folder.path(), ": is a folder, not a log"}}) {
    try {
      (void)OpenLog(path);
      FAIL();
    } catch (const std::runtime_error& e) {
      EXPECT_EQ(e.what(), path.string() + what);
    }
  }
}

}  // namespace
}  // namespace scoria::logs
