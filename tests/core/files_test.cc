// SPDX-License-Identifier: BSD-3-Clause
#include "core/files.h"

#include <cerrno>
#include <set>

#include <gtest/gtest.h>

#include "core/folder_lock.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

namespace fs = std::filesystem;

TEST(Files, AreWrittenWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "a.txt";
  WriteText(file, "first");
  WriteText(file, "second");
  EXPECT_EQ(ReadText(file), "second");
  fs::create_directory(folder.path() / "b.txt");  // cannot be replaced by a file
  fs::create_directory(folder.path() / "b.txt" / "c");
  EXPECT_THROW(WriteText(folder.path() / "b.txt", "x"), FileError);
  for (const auto& entry : fs::directory_iterator(folder.path()))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST(Files, ErrorsNameTheFileAndTheReason) {
  const test::TemporaryFolder folder;
  const fs::path missing = folder.path() / "no" / "a.txt";
  try {
    WriteText(missing, "x");
    FAIL();
  } catch (const FileError& e) {
    EXPECT_EQ(std::string(e.what()),
              missing.string() + ": cannot write: no such file or directory");
  }
  EXPECT_EQ(std::string(FileError("v.mp4", "cannot write", ENOSPC).what()),
            "v.mp4: cannot write: no space left on device");
  EXPECT_EQ(std::string(FileError("v.mp4", "cut", 0).what()), "v.mp4: cut");
  try {
    WriteText(folder.path() / "a", "x");
    CreateFolders(folder.path() / "a" / "b");
    FAIL();
  } catch (const FileError& e) {
    EXPECT_EQ(std::string(e.what()),
              (folder.path() / "a" / "b").string() + ": cannot create the folder: not a directory");
  }
}

TEST(Files, HashTellsContentsApart) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "a";
  EXPECT_FALSE(HashFile(file).has_value());
  WriteText(file, std::string(200000, 'x') + "1");
  const auto one = HashFile(file);
  ASSERT_TRUE(one.has_value());
  WriteText(file, std::string(200000, 'x') + "2");
  EXPECT_NE(HashFile(file), one);
  WriteText(file, std::string(200000, 'x') + "1");
  EXPECT_EQ(HashFile(file), one);
}

TEST(FileNames, PlainTextStaysAsItIs) {
  for (const char* name : {"ags", "sgs_matched", "0.3", "ags-0.5", "operator.speed_mps"})
    EXPECT_EQ(FileNameOf(name), name);
}

TEST(FileNames, EveryTextHasAnotherNameThatIsOneSafeComponent) {
  const std::vector<std::string> texts = {"50 % \"x\"\\y",
                                          "50 % \"x\"/y",
                                          "a b",
                                          "a_b",
                                          "a\tb",
                                          "..",
                                          ".",
                                          ".hidden",
                                          "-rf",
                                          "",
                                          "/",
                                          "$(x)",
                                          "`x`",
                                          "<b>",
                                          "Rückweg",
                                          "Ruckweg",
                                          "歩行",
                                          std::string(5000, 'x'),
                                          std::string(5000, 'x') + "y",
                                          std::string("nul\0l", 5)};
  std::set<std::string> names;
  for (const std::string& text : texts) {
    const std::string name = FileNameOf(text);
    EXPECT_TRUE(names.insert(name).second) << name;
    EXPECT_LE(name.size(), 100u);
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                     "0123456789._-"),
              std::string::npos)
        << name;
    EXPECT_NE(name.front(), '.');
  }
}

TEST(FolderLock, SecondHolderIsRefusedUntilTheFirstLetsGo) {
  const test::TemporaryFolder folder;
  const fs::path path = folder.path() / "run";
  {
    const FolderLock first(path);
    try {
      const FolderLock second(path);
      FAIL();
    } catch (const FolderInUse& e) {
      EXPECT_EQ(std::string(e.what()),
                path.string() + ": another process is writing to this folder");
    }
  }
  EXPECT_NO_THROW(FolderLock(path, std::chrono::milliseconds(0)));
}

}  // namespace
}  // namespace scoria::core
