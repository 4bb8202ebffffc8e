// SPDX-License-Identifier: BSD-3-Clause
// Follows what the pages of the repository point at: links, anchors, files.
#include <algorithm>
#include <fstream>
#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/markdown.h"
#include "tests/support/robots.h"

namespace scoria {
namespace {

namespace fs = std::filesystem;

bool IsLeftOut(const fs::path& folder) {
  const std::string name = folder.filename().string();
  return name.starts_with('.') || name.starts_with("build") || name == "out";
}

/// All pages below `root`, builds and outputs left out.
std::vector<fs::path> PagesBelow(const fs::path& root) {
  std::vector<fs::path> pages;
  for (auto it = fs::recursive_directory_iterator(root); it != fs::recursive_directory_iterator();
       ++it) {
    if (it->is_directory() && IsLeftOut(it->path())) {
      it.disable_recursion_pending();
    } else if (it->path().extension() == ".md") {
      pages.push_back(it->path());
    }
  }
  std::sort(pages.begin(), pages.end());
  return pages;
}

bool LeadsOutside(const std::string& target) {
  return target.starts_with("https://") || target.starts_with("http://") ||
         target.starts_with("mailto:");
}

/// What is wrong with a link on `page`, empty if nothing.
std::string LinkProblem(const fs::path& page, const std::string& target) {
  const std::size_t hash = target.find('#');
  const std::string path = target.substr(0, hash);
  const fs::path file = path.empty() ? page : page.parent_path() / path;
  if (!fs::exists(file)) return "there is no such file";
  if (hash == std::string::npos) return "";
  const std::string anchor = target.substr(hash + 1);
  if (!test::Anchors(test::ReadPage(file)).contains(anchor)) return "there is no such heading";
  return "";
}

/// Place, target and problem of every dead link of a page.
std::vector<std::string> DeadLinks(const fs::path& file) {
  std::vector<std::string> dead;
  const test::Page page = test::ReadPage(file);
  for (std::size_t i = 0; i < page.size(); ++i) {
    for (const std::string& target : test::LinkTargets(page[i])) {
      const std::string problem = LeadsOutside(target) ? "" : LinkProblem(file, target);
      if (!problem.empty())
        dead.push_back(fmt::format("{}:{}: {}: {}", file.string(), i + 1, target, problem));
    }
  }
  return dead;
}

TEST(Docs, LinksLeadToFilesAndHeadings) {
  const std::vector<fs::path> pages = PagesBelow(test::SourcePath(""));
  EXPECT_GT(pages.size(), 10u);
  for (const fs::path& page : pages) {
    for (const std::string& dead : DeadLinks(page)) ADD_FAILURE() << dead;
  }
}

TEST(Docs, DeadLinksAreFound) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.path() / "page.md";
  std::ofstream(file)
      << "# One heading: `x`\n"
         "[here](#one-heading-x), [itself](page.md#one-heading-x), [web](https://a.b)\n"
         "[gone](other.md), [nowhere](#two), ![picture](picture.png)\n"
         "`[code](code.md)`\n"
         "```\n[fenced](fenced.md)\n```\n";
  const std::vector<std::string> dead = DeadLinks(file);
  ASSERT_EQ(dead.size(), 3u);
  EXPECT_EQ(dead[0], file.string() + ":3: other.md: there is no such file");
  EXPECT_EQ(dead[1], file.string() + ":3: #two: there is no such heading");
  EXPECT_EQ(dead[2], file.string() + ":3: picture.png: there is no such file");
}

/// Files of the repository that a page names between backticks, with their folder.
std::vector<std::string> NamedFiles(const test::Page& page) {
  const std::regex pattern(
      "(core|terrains|logs|sim|controller|analysis|app|tests|docs|robots|scenarios|campaigns)/"
      "[A-Za-z0-9_./-]*");
  std::vector<std::string> files;
  for (const std::string& line : page) {
    for (const std::string& span : test::CodeSpans(line)) {
      if (std::regex_match(span, pattern)) files.push_back(span);
    }
  }
  return files;
}

/// Pages that tell what was, not what is.
bool IsHistory(const fs::path& page) {
  return page.filename() == "CHANGELOG.md" || page.parent_path().filename() == "results";
}

TEST(Docs, FilesThatPagesNameExist) {
  for (const fs::path& page : PagesBelow(test::SourcePath(""))) {
    if (IsHistory(page)) continue;
    for (const std::string& file : NamedFiles(test::ReadPage(page)))
      EXPECT_TRUE(fs::exists(test::SourcePath(file))) << page << " names " << file;
  }
}

TEST(Docs, ArchitectureNamesTheFilesOfEveryKindOfNewPart) {
  const test::Page page = test::ReadPage(test::SourcePath("docs/architecture.md"));
  for (const char* part :
       {"A new estimator", "A new metric", "A new event", "A new log format", "A new QP solver"}) {
    const test::Page section = test::Section(page, part);
    EXPECT_GE(NamedFiles(section).size(), 5u) << part;
  }
}

/// The lines before the first section.
test::Page HeadOf(const test::Page& page) {
  const auto section = std::find_if(
      page.begin(), page.end(), [](const std::string& line) { return line.starts_with("## "); });
  return {page.begin(), section};
}

TEST(Docs, PagesOfResultsBeginWithDateRevisionAndCommand) {
  const std::regex date(R"(\d{4}-\d{2}-\d{2})"), revision("`[0-9a-f]{7,40}`");
  const std::vector<fs::path> pages = PagesBelow(test::SourcePath("docs/results"));
  EXPECT_GE(pages.size(), 4u);
  for (const fs::path& file : pages) {
    const test::Page page = test::ReadPage(file);
    const std::vector<std::string> headings = test::Headings(page);
    const std::vector<test::TableRow> table = test::FirstTable(HeadOf(page));
    ASSERT_GE(table.size(), 2u) << file;
    EXPECT_EQ(table[0], (test::TableRow{"section", "date", "revision", "command"})) << file;
    for (std::size_t i = 1; i < table.size(); ++i) {
      const test::TableRow& row = table[i];
      ASSERT_EQ(row.size(), 4u) << file << " row " << i;
      EXPECT_TRUE(std::find(headings.begin(), headings.end(), row[0]) != headings.end())
          << file << " has no section " << row[0];
      EXPECT_TRUE(std::regex_match(row[1], date)) << file << ": " << row[1];
      EXPECT_TRUE(std::regex_search(row[2], revision)) << file << ": " << row[2];
      EXPECT_FALSE(row[3].empty()) << file << ": " << row[0];
    }
  }
}

}  // namespace
}  // namespace scoria
