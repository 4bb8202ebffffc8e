// SPDX-License-Identifier: BSD-3-Clause
// What the controller links: it could run on hardware, where no file format has a place.
#include <cstdio>
#include <fstream>
#include <memory>
#include <regex>
#include <set>

#include <gtest/gtest.h>

namespace scoria {
namespace {

/// What a command prints.
std::string OutputOf(const std::string& command) {
  std::string output;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  if (!pipe) return output;
  for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
    output += static_cast<char>(c);
  return output;
}

/// By CMake's own graph, down to the last library: nothing but mathematics, text and threads.
TEST(Links, ControllerAsksForNoFileFormat) {
  const std::set<std::string> allowed = {"Eigen3::Eigen", "fmt::fmt", "utf8cpp", "Threads::Threads",
                                         "scoria_options"};
  std::ifstream in(CONTROLLER_LINKS);
  std::set<std::string> targets;
  for (std::string from, to; in >> from >> to;) {
    targets.insert(from);
    const bool is_ours = to.starts_with("scoria_");  // its own links stand in other lines
    EXPECT_TRUE(is_ours || allowed.contains(to)) << from << " links " << to;
  }
  EXPECT_TRUE(targets.contains("scoria_controller"));
  EXPECT_TRUE(targets.contains("scoria_core"));
}

/// By the linker: a program of all the controller's objects and of what they link.
TEST(Links, ControllerNeedsNoLibraryOfAFileFormat) {
  const std::string output = OutputOf(std::string("readelf -d ") + CONTROLLER_ALONE);
  const std::regex needed(R"(\(NEEDED\).*\[(lib)?([a-z_+-]+))");
  const std::set<std::string> allowed = {"stdc++", "m",          "gcc_s", "c",     "pthread",
                                         "fmt",    "ld-linux-x", "asan",  "ubsan", "tsan"};
  int libraries = 0;
  for (std::sregex_iterator it(output.begin(), output.end(), needed), end; it != end; ++it) {
    ++libraries;
    EXPECT_TRUE(allowed.contains((*it)[2])) << (*it)[0];
  }
  EXPECT_GT(libraries, 2) << output;
}

}  // namespace
}  // namespace scoria
