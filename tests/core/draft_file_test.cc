// SPDX-License-Identifier: BSD-3-Clause
#include "core/draft_file.h"

#include <gtest/gtest.h>

#include "core/files.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

namespace fs = std::filesystem;

TEST(DraftFile, HasItsNameOnlyWhenItIsWhole) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "a.csv";
  WriteText(path, "old");
  DraftFile file(path);
  const std::string piece(100'000, 'x');
  for (int i = 0; i < 5; ++i) file.Append(piece);
  EXPECT_EQ(ReadText(path), "old");
  file.Publish();
  EXPECT_EQ(ReadText(path).size(), 500'000u);
  EXPECT_FALSE(fs::exists(DraftNameOf(path)));
}

TEST(DraftFile, LeavesNothingBehindWithoutPublish) {
  const test::TemporaryFolder folder;
  { DraftFile(folder.path() / "a.csv").Append("x"); }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(DraftFile, SaysWhatTheSystemRefuses) {
  try {
    DraftFile file("/none/a.csv");
    FAIL() << "opened";
  } catch (const FileError& error) {
    EXPECT_STREQ(error.what(), "/none/a.csv: cannot write: no such file or directory");
  }
}

}  // namespace
}  // namespace scoria::core
