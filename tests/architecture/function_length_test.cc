// SPDX-License-Identifier: BSD-3-Clause
// Functions fit on a screen.
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/robots.h"

namespace scoria {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> LinesOf(const fs::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::size_t Indent(const std::string& line) { return line.find_first_not_of(' '); }

struct Function {
  std::size_t first_line, lines;
};

/// Functions by the layout that the formatter gives them: the closing brace stands below the first
/// letter of the line that opens the body or begins the declaration.
std::vector<Function> FunctionsOf(const std::vector<std::string>& lines) {
  static const std::regex kBody(R"(^( {0,4})[^ /#].*\{$|^( {0,4}) {4,}\S.*\) .*\{$)");
  static const std::regex kOther(
      R"(^\s*(namespace|class|struct|enum|union|extern|template)\b|= \{+$|^\s*\{|\bstruct \w+ \{$)");
  std::vector<Function> functions;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (!std::regex_search(lines[i], kBody) || std::regex_search(lines[i], kOther)) continue;
    std::size_t head = i;  // where the declaration begins
    while (head > 0 && Indent(lines[head]) > 4) --head;
    const std::size_t indent = Indent(lines[head]);
    for (std::size_t j = i + 1; j < lines.size(); ++j) {
      const std::size_t at = Indent(lines[j]);
      if (at > indent || at == std::string::npos || lines[j][at] != '}') continue;
      functions.push_back({i + 1, j - i});
      break;
    }
  }
  return functions;
}

TEST(Functions, AreFoundByTheirLayout) {
  const std::vector<Function> found =
      FunctionsOf({"namespace a {", "int F() {", "  return 1;", "}", "class B {", "  void G(int a,",
                   "         int b) const {", "    if (a) {", "    }", "  }", "};", "}"});
  ASSERT_GE(found.size(), 2u);
  EXPECT_EQ(found[0].first_line, 2u);
  EXPECT_EQ(found[0].lines, 2u);
  EXPECT_EQ(found[1].first_line, 7u);
  EXPECT_EQ(found[1].lines, 3u);
}

TEST(Functions, HaveAtMostSixtyLines) {
  constexpr std::size_t kMost = 60;
  std::size_t functions = 0;
  for (const char* top : {"analysis", "app", "controller", "core", "logs", "sim", "terrains"}) {
    for (const auto& entry : fs::recursive_directory_iterator(test::SourcePath(top))) {
      if (entry.path().extension() != ".cc" && entry.path().extension() != ".h") continue;
      for (const Function& f : FunctionsOf(LinesOf(entry.path()))) {
        ++functions;
        EXPECT_LE(f.lines, kMost) << entry.path().string() << ":" << f.first_line;
      }
    }
  }
  EXPECT_GT(functions, 1500u);
}

}  // namespace
}  // namespace scoria
