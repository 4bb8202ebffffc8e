// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/xacro.h"

#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/config/node.h"
#include "core/files.h"
#include "core/robot_files/load.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

/// With a folder of its own as the only one where programs are looked for.
class Xacro : public testing::Test {
 protected:
  void SetUp() override {
    const char* path = std::getenv("PATH");
    path_ = path == nullptr ? "" : path;
    std::filesystem::create_directory(folder_.path() / "bin");
    setenv("PATH", (folder_.path() / "bin").c_str(), 1);
    config_ = test::Go2().config;
    config_.urdf = folder_.path() / "it's a dog.xacro";
    WriteText(config_.urdf, "<robot name=\"go2\"><xacro:legs/></robot>");
  }
  void TearDown() override { setenv("PATH", path_.c_str(), 1); }

  void Install(const std::string& script) {
    const std::filesystem::path program = folder_.path() / "bin" / "xacro";
    WriteText(program, "#!/bin/sh\n" + script);
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] std::string Error() const {
    try {
      (void)ReadRobot(config_);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "no error";
  }

  const test::TemporaryFolder folder_;
  std::string path_;
  RobotConfig config_;
};

TEST_F(Xacro, IsExpandedByTheProgram) {
  WriteText(folder_.path() / "go2.urdf", test::Go2().urdf_text);
  Install(
      "echo 'warning: redefining' >&2\nwhile read line; do echo \"$line\"; done < \"${1%/*}\"/"
      "go2.urdf\n");
  EXPECT_EQ(Error(), "no error");
  EXPECT_EQ(ReadRobot(config_).total_mass_kg(), test::Go2().total_mass_kg());
}

TEST_F(Xacro, WithoutTheProgramIsSaidInOneLine) {
  EXPECT_EQ(Error(), config_.urdf.string() +
                         ": urdf: is a xacro, and the program xacro, which expands it, is not "
                         "installed (pip install xacro); or expand it elsewhere: xacro IN > "
                         "OUT.urdf");
}

TEST_F(Xacro, ComplaintOfTheProgramIsShown) {
  Install("echo 'Traceback:' >&2\necho 'unknown macro name: xacro:legs' >&2\nexit 2\n");
  EXPECT_EQ(Error(), config_.urdf.string() +
                         ": urdf: the program xacro fails on it: unknown macro name: xacro:legs");
}

}  // namespace
}  // namespace scoria::core
