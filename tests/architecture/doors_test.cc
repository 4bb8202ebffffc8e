// SPDX-License-Identifier: BSD-3-Clause
// Reads every #include of the repository and holds it against the house plan.
#include <fstream>
#include <map>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace scoria {
namespace {

namespace fs = std::filesystem;

struct Include {
  fs::path file;  // relative to the repository
  std::string target;
  bool quoted = false;
};

std::vector<Include> AllIncludes() {
  std::vector<Include> all;
  const fs::path root = test::SourcePath("");
  const std::regex pattern(R"(^\s*#include\s+([<"])([^>"]+)[>"])");
  for (const char* folder :
       {"core", "terrains", "logs", "sim", "controller", "analysis", "app", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cc") continue;
      std::ifstream in(entry.path());
      for (std::string line; std::getline(in, line);) {
        std::smatch match;
        if (std::regex_search(line, match, pattern))
          all.push_back({fs::relative(entry.path(), root), match[2], match[1] == "\""});
      }
    }
  }
  return all;
}

std::string Top(const fs::path& path) { return path.begin()->string(); }

TEST(Doors, FoldersIncludeOnlyWhatTheHousePlanAllows) {
  const std::map<std::string, std::set<std::string>> allowed = {
      {"core", {"core"}},
      {"terrains", {"core", "terrains"}},
      {"logs", {"core", "logs"}},
      {"sim", {"core", "terrains", "sim"}},
      {"controller", {"core", "controller"}},
      {"analysis", {"core", "terrains", "logs", "analysis"}},
      {"app", {"core", "terrains", "logs", "sim", "controller", "analysis", "app"}},
      {"tests", {"core", "terrains", "logs", "sim", "controller", "analysis", "app", "tests"}}};
  int checked = 0;
  for (const Include& i : AllIncludes()) {
    if (!i.quoted) continue;
    ++checked;
    EXPECT_TRUE(allowed.at(Top(i.file)).contains(Top(i.target)))
        << i.file << " includes " << i.target;
  }
  EXPECT_GT(checked, 200);
}

TEST(Doors, ControllerStagesDoNotKnowEachOther) {
  const std::set<std::string> siblings = {"estimation", "gait", "reference",  "mpc",
                                          "swing",      "wbc",  "adaptation", "safety"};
  for (const Include& i : AllIncludes()) {
    if (!i.quoted || Top(i.file) != "controller" || Top(i.target) != "controller") continue;
    const std::string from = std::next(i.file.begin())->string();
    const fs::path target(i.target);
    const std::string to = std::next(target.begin())->string();
    if (siblings.contains(from)) {
      EXPECT_TRUE(to == from || to == "model" || to == "qp") << i.file << " includes " << i.target;
    }
    if (from == "model" || from == "qp") {
      EXPECT_EQ(to, from) << i.file << " includes " << i.target;
    }
  }
}

TEST(Doors, EnginesStayInTheirRooms) {
  for (const Include& i : AllIncludes()) {
    const std::string top = Top(i.file);
    if (i.target.find("Bullet") != std::string::npos ||
        i.target.find("bullet") != std::string::npos) {
      EXPECT_TRUE(top == "sim" && i.file.extension() == ".cc")
          << i.file << " includes " << i.target;
    }
    if (i.target.starts_with("opencv2") || i.target.starts_with("GL/")) {
      EXPECT_TRUE(top == "analysis" && i.file.extension() == ".cc")
          << i.file << " includes " << i.target;
    }
    if (i.target.starts_with("spdlog") || i.target.starts_with("CLI/")) {
      EXPECT_EQ(top, "app") << i.file;
    }
  }
}

}  // namespace
}  // namespace scoria
