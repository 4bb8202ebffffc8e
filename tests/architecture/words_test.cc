// SPDX-License-Identifier: BSD-3-Clause
// The field's terms instead of private ones, in code, configuration and pages. The former names of
// keys stay as aliases, and nowhere else.
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

struct Word {
  const char* wrong;  // regular expression, whatever the case
  const char* right;
};
constexpr Word kWords[] = {
    {R"(\bfelt\b|\bfeels?\b|felt_)", "sense, estimate"},
    {R"(word that count|whose word|word of the foot|ContactWord|kCounted)", "fused contact"},
    {R"(\bdoubts?\b)", "covariance scale"},
    {R"(mishap)", "stumble"},
    {R"(contradict)", "residual, disagreement"},
    {R"(\bgiven up\b|\bgives? up\b|given_up|\btaken back\b|\btakes? back\b|\bcomes? back\b)",
     "engage, release the fallback"},
    {R"((^|[^a-z])watch(es|ed|ing)?([^a-z]|$)|NumWatches|WatchParams)", "monitor"},
    {R"(hand_?over|hand-over|\bhand(s|ed)? over\b)", "model update gate"},
    {R"(honest)", "realistic"},
    {R"((across|along)_W\b|\.(across|along)\b)", "tangent1, tangent2"},
    {R"(\bcarried on\b)", "repositioned"},
    {R"(house convention)", "canonical joint convention"},
    {R"(\blest\b)", "so that … not"},
};

bool IsText(const fs::path& file) {
  for (const char* extension : {".h", ".cc", ".yaml", ".md", ".txt", ".msg"}) {
    if (file.extension() == extension) return true;
  }
  return false;
}

bool IsAlias(const std::string& line) {
  return line.find(".was = \"") != std::string::npos ||
         line.find("kFormerType = \"") != std::string::npos;
}

/// "file:line: "x" is to be y", for every wrong word of a file.
void AppendWrongWords(const fs::path& file, std::vector<std::string>& out) {
  static const std::vector<std::regex> kPatterns = [] {
    std::vector<std::regex> patterns;
    for (const Word& word : kWords) patterns.emplace_back(word.wrong, std::regex::icase);
    return patterns;
  }();
  std::ifstream in(file);
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (IsAlias(line)) continue;
    for (std::size_t i = 0; i < kPatterns.size(); ++i) {
      std::smatch match;
      if (std::regex_search(line, match, kPatterns[i]))
        out.push_back(
            fmt::format("{}:{}: \"{}\": {}", file.string(), number, match.str(), kWords[i].right));
    }
  }
}

TEST(Words, AreTheFieldsTerms) {
  std::vector<std::string> wrong;
  int files = 0;
  for (const char* top : {"analysis", "app", "campaigns", "controller", "core", "docs", "logs",
                          "robots", "scenarios", "sim", "terrains", "tests", "README.md"}) {
    const fs::path path = test::SourcePath(top);
    if (fs::is_regular_file(path)) AppendWrongWords(path, wrong);
    if (!fs::is_directory(path)) continue;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path)) {
      const bool own = entry.path().filename() == "words_test.cc";
      if (!entry.is_regular_file() || !IsText(entry.path()) || own) continue;
      ++files;
      AppendWrongWords(entry.path(), wrong);
    }
  }
  EXPECT_GT(files, 500);
  EXPECT_TRUE(wrong.empty()) << fmt::format("{}", fmt::join(wrong, "\n"));
}

}  // namespace
}  // namespace scoria
