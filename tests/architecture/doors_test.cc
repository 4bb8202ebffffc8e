// SPDX-License-Identifier: BSD-3-Clause
// Reads every #include of the repository and holds it against the tables of docs/architecture.md.
#include <algorithm>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "tests/support/markdown.h"
#include "tests/support/robots.h"

namespace scoria {
namespace {

namespace fs = std::filesystem;

using Strings = std::vector<std::string>;

struct Include {
  std::string file;  // relative to the repository
  std::string target;
  bool quoted = false;
};

bool IsSource(const fs::path& file) {
  return file.extension() == ".h" || file.extension() == ".cc";
}

/// Sources of the repository, relative to it; builds and outputs left out.
std::vector<fs::path> Sources() {
  std::vector<fs::path> sources;
  const fs::path root = test::SourcePath("");
  for (const auto& folder : fs::directory_iterator(root)) {
    const std::string name = folder.path().filename().string();
    const bool left_out = name.starts_with('.') || name.starts_with("build") || name == "out";
    if (!folder.is_directory() || left_out) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      if (IsSource(entry.path())) sources.push_back(fs::relative(entry.path(), root));
    }
  }
  return sources;
}

std::vector<Include> AllIncludes() {
  const std::regex pattern(R"(^\s*#include\s+([<"])([^>"]+)[>"])");
  std::vector<Include> all;
  for (const fs::path& source : Sources()) {
    std::ifstream in(test::SourcePath(source.string()));
    for (std::string line; std::getline(in, line);) {
      std::smatch match;
      if (std::regex_search(line, match, pattern))
        all.push_back({source.string(), match[2], match[1] == "\""});
    }
  }
  return all;
}

/// Rows of a table of docs/architecture.md, without its head.
std::vector<test::TableRow> TableOf(const std::string& heading) {
  const test::Page page = test::ReadPage(test::SourcePath("docs/architecture.md"));
  std::vector<test::TableRow> table = test::FirstTable(test::Section(page, heading));
  if (!table.empty()) table.erase(table.begin());
  return table;
}

bool StartsWithAny(const std::string& text, const Strings& beginnings) {
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string& beginning) { return text.starts_with(beginning); });
}

bool Has(const Strings& list, const std::string& item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

/// What the files of a folder may include of the repository.
struct FolderRule {
  std::string folder;
  Strings allowed;  // other folders
};

std::vector<FolderRule> FolderRules() {
  std::vector<FolderRule> rules;
  for (const test::TableRow& row : TableOf("Folders and what they may include")) {
    for (const std::string& folder : test::CodeSpans(row.at(0)))
      rules.push_back({folder, test::CodeSpans(row.at(2))});
  }
  return rules;
}

/// The rule of the longest folder that `file` lies in; null if there is none.
const FolderRule* RuleOf(const std::vector<FolderRule>& rules, const std::string& file) {
  const FolderRule* best = nullptr;
  for (const FolderRule& rule : rules) {
    if (!file.starts_with(rule.folder)) continue;
    if (best == nullptr || rule.folder.size() > best->folder.size()) best = &rule;
  }
  return best;
}

TEST(Doors, TheLongestFolderBindsAFile) {
  const std::vector<FolderRule> rules = {{"a/", {}}, {"a/b/", {}}, {"c/", {}}};
  EXPECT_EQ(RuleOf(rules, "a/x.h"), &rules[0]);
  EXPECT_EQ(RuleOf(rules, "a/b/x.h"), &rules[1]);
  EXPECT_EQ(RuleOf(rules, "d/x.h"), nullptr);
}

TEST(Doors, FoldersIncludeOnlyWhatTheArchitectureAllows) {
  const std::vector<FolderRule> rules = FolderRules();
  int checked = 0;
  for (const Include& i : AllIncludes()) {
    // A quoted file that is no header stands in a text, not in code.
    if (!i.quoted || !i.target.ends_with(".h")) continue;
    ++checked;
    const FolderRule* rule = RuleOf(rules, i.file);
    ASSERT_NE(rule, nullptr) << i.file << " lies in no folder of the table";
    EXPECT_TRUE(i.target.starts_with(rule->folder) || StartsWithAny(i.target, rule->allowed))
        << i.file << " includes " << i.target;
  }
  EXPECT_GT(checked, 200);
}

TEST(Doors, StagesOfTheControllerHaveRulesOfTheirOwn) {
  const std::vector<FolderRule> rules = FolderRules();
  for (const auto& entry : fs::directory_iterator(test::SourcePath("controller"))) {
    if (!entry.is_directory()) continue;
    const std::string folder = "controller/" + entry.path().filename().string() + "/";
    const FolderRule* rule = RuleOf(rules, folder);
    ASSERT_NE(rule, nullptr);
    EXPECT_EQ(rule->folder, folder);
  }
}

/// Structs that say what they hold know no reader: configs and robots come to them as values.
TEST(Doors, ControllerAndValuesOfCoreKnowNoReaderOfFiles) {
  const Strings readers = {"core/config/", "core/robot_files/"};
  for (const Include& i : AllIncludes()) {
    const bool is_bound = StartsWithAny(i.file, {"core/", "controller/"});
    if (!is_bound || StartsWithAny(i.file, readers)) continue;
    EXPECT_TRUE(!StartsWithAny(i.target, readers) || i.target == "core/config/field.h" ||
                i.target == "core/config/scale.h")
        << i.file << " includes " << i.target;
  }
}

TEST(Doors, NoTwoFoldersIncludeEachOther) {
  const std::vector<FolderRule> rules = FolderRules();
  for (const FolderRule& a : rules) {
    for (const FolderRule& b : rules) {
      EXPECT_FALSE(Has(a.allowed, b.folder) && Has(b.allowed, a.folder))
          << a.folder << " and " << b.folder;
    }
  }
}

/// Where a library's headers may be included.
struct LibraryRule {
  Strings headers;  // their beginnings
  Strings places;   // paths, * for anything
};

std::vector<LibraryRule> LibraryRules() {
  std::vector<LibraryRule> rules;
  for (const test::TableRow& row : TableOf("Libraries and where they are included"))
    rules.push_back({test::CodeSpans(row.at(1)), test::CodeSpans(row.at(2))});
  return rules;
}

bool Matches(const std::string& path, const std::string& pattern) {
  const std::size_t star = pattern.find('*');
  if (star == std::string::npos) return path == pattern;
  return path.starts_with(pattern.substr(0, star)) && path.ends_with(pattern.substr(star + 1));
}

TEST(Doors, PlacesMayBeSourcesAlone) {
  EXPECT_TRUE(Matches("sim/contact/finder.cc", "sim/*.cc"));
  EXPECT_FALSE(Matches("sim/contact/finder.h", "sim/*.cc"));
  EXPECT_FALSE(Matches("app/main.cc", "sim/*.cc"));
  EXPECT_TRUE(Matches("app/main.cc", "*"));
}

TEST(Doors, LibrariesAreIncludedOnlyWhereTheArchitectureAllows) {
  const std::vector<LibraryRule> rules = LibraryRules();
  for (const Include& i : AllIncludes()) {
    const bool is_standard = i.target.find_first_of("./") == std::string::npos;
    if (i.quoted || is_standard) continue;
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const LibraryRule& r) {
      return StartsWithAny(i.target, r.headers);
    });
    ASSERT_TRUE(rule != rules.end()) << i.file << ": " << i.target << " is in no row of the table";
    EXPECT_TRUE(std::any_of(rule->places.begin(), rule->places.end(),
                            [&](const std::string& place) { return Matches(i.file, place); }))
        << i.file << " includes " << i.target;
  }
}

}  // namespace
}  // namespace scoria
