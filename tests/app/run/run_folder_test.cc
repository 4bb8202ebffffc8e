// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/run_folder.h"

#include <gtest/gtest.h>

#include "core/files.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

void WriteResult(const fs::path& folder, const std::string& text) {
  core::CreateFolders(folder);
  core::WriteText(folder / "result.json", text);
}

std::string Refusal(const fs::path& out) {
  try {
    (void)TakeRunFolder(out, "", false);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "none";
}

TEST(RunFolder, FinishedRunIsKept) {
  const test::TemporaryFolder folder;
  const fs::path flat = folder.path() / "flat";
  EXPECT_EQ(TakeRunFolder("", flat, false).path, flat);
  WriteResult(flat, R"({"end": "completed"})");
  EXPECT_EQ(TakeRunFolder("", flat, false).path, flat.string() + "-2");
  WriteResult(flat.string() + "-2", R"({"end": "fall_limit"})");
  EXPECT_EQ(TakeRunFolder("", flat, false).path, flat.string() + "-3");
  EXPECT_EQ(TakeRunFolder("", flat, true).path, flat);
  EXPECT_EQ(TakeRunFolder(flat, "", true).path, flat);
  EXPECT_EQ(
      Refusal(flat),
      flat.string() +
          ": holds a finished run; choose another folder by --out or overwrite it by --force");
  core::WriteText(folder.path() / "campaign.json", "{}");
  EXPECT_EQ(Refusal(folder.path()),
            folder.path().string() +
                ": holds a campaign; choose another folder by --out or overwrite it by --force");
}

TEST(RunFolder, WhatIsNoFinishedRunIsNotKept) {
  const test::TemporaryFolder folder;
  const fs::path flat = folder.path() / "flat";
  for (const char* text : {"", "{", "[]", R"({"end": "interrupted"})", R"({"end": 3})"}) {
    WriteResult(flat, text);
    EXPECT_EQ(TakeRunFolder("", flat, false).path, flat) << text;
    EXPECT_EQ(Refusal(flat), "none") << text;
  }
}

TEST(RunFolder, IsHeldAgainstOthers) {
  const test::TemporaryFolder folder;
  const fs::path flat = folder.path() / "flat";
  const RunFolder held = TakeRunFolder(flat, "", false);
  EXPECT_EQ(Refusal(flat), flat.string() + ": another process is writing to this folder");
  EXPECT_EQ(TakeRunFolder("", flat, false).path, flat.string() + "-2");
}

std::vector<std::string> ShortRun(const std::string& name) {
  return {"run",   test::SourcePath("scenarios/flat.yaml").string(),
          "--set", "duration_s=0.2",
          "--set", "terrain.size_m=6.4",
          "--set", "terrain.resolution_m=0.1",
          "--set", "name=" + name};
}

TEST(RunCommand, SecondRunGoesToAFolderOfItsOwnAndSaysSo) {
  const test::TemporaryFolder folder;
  const test::ProgramOptions here{.folder = folder.path()};
  EXPECT_EQ(test::RunScoria(ShortRun("a"), here).code, 0);
  const test::ProgramEnd second = test::RunScoria(ShortRun("a"), here);
  EXPECT_EQ(second.code, 0);
  EXPECT_NE(second.output.find("out/a is taken; writing to out/a-2\n"), std::string::npos)
      << second.output;
  EXPECT_TRUE(fs::exists(folder.path() / "out/a-2/result.json"));

  std::vector<std::string> named = ShortRun("a");
  named.insert(named.end(), {"--out", "out/a"});
  EXPECT_EQ(test::RunScoria(named, here).code, 2);
  named.push_back("--force");
  EXPECT_EQ(test::RunScoria(named, here).code, 0);
}

TEST(RunCommand, AnyNameIsAFolder) {
  const test::TemporaryFolder folder;
  const test::ProgramOptions here{.folder = folder.path()};
  EXPECT_EQ(test::RunScoria(ShortRun("../x/50 %"), here).code, 0);
  int folders = 0;
  for (const auto& entry : fs::directory_iterator(folder.path() / "out")) {
    ++folders;
    EXPECT_TRUE(fs::exists(entry.path() / "result.json"));
  }
  EXPECT_EQ(folders, 1);
}

TEST(RunCommand, WhatTheDiskRefusesIsOneLineAndACodeOfItsOwn) {
  const test::TemporaryFolder folder;
  std::vector<std::string> run = ShortRun("a");
  run.push_back("--quiet");
  constexpr rlim_t kTooSmall = 20000;
  const test::ProgramEnd end =
      test::RunScoria(run, {.folder = folder.path(), .largest_file = kTooSmall});
  EXPECT_EQ(end.code, 4);
  EXPECT_EQ(end.output, "out/a/log.mcap: cannot write: file too large\n");
  EXPECT_FALSE(fs::exists(folder.path() / "out/a/result.json"));
}

/// Friction holds its joints.
TEST(RunCommand, RobotThatDoesNotWalkIsAFailure) {
  const test::TemporaryFolder folder;
  std::vector<std::string> run = ShortRun("lame");
  run.insert(run.end(), {"--quiet", "--set", "duration_s=8", "--set", "start=standing", "--set",
                         "robot.motors.friction_Nm=[10,10,10]", "--set", "log.keep=metrics"});
  const test::ProgramEnd end = test::RunScoria(run, {.folder = folder.path()});
  EXPECT_EQ(end.code, 1);
  EXPECT_NE(end.output.find("lame: walked 0.0"), std::string::npos) << end.output;
  EXPECT_NE(end.output.find(" m where 1.50 m were commanded\n"), std::string::npos) << end.output;
}

}  // namespace
}  // namespace scoria::app
