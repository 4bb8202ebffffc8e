// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/markdown.h"

#include <cctype>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include <fmt/format.h>

namespace scoria::test {
namespace {

std::string Trim(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Number of signs # before a heading's text; 0 for any other line.
std::size_t HeadingLevel(const std::string& line) {
  constexpr std::size_t kDeepest = 6;
  const std::size_t level = line.find_first_not_of('#');
  const bool is_heading = level != std::string::npos && level <= kDeepest && line[level] == ' ';
  return is_heading ? level : 0;
}

std::string HeadingText(const std::string& line) { return Trim(line.substr(HeadingLevel(line))); }

/// Lower case, spaces as dashes, without punctuation and without targets of links.
std::string AnchorOf(const std::string& heading) {
  const std::regex target(R"(\]\([^)]*\))");
  std::string anchor;
  for (const char c : std::regex_replace(heading, target, "]")) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_ascii = byte < 0x80;
    if (c == ' ') {
      anchor += '-';
    } else if (!is_ascii || c == '-' || c == '_') {
      anchor += c;
    } else if (std::isalnum(byte) != 0) {
      anchor += static_cast<char>(std::tolower(byte));
    }
  }
  return anchor;
}

TableRow CellsOf(const std::string& line) {
  TableRow cells;
  std::istringstream in(Trim(line).substr(1));
  for (std::string cell; std::getline(in, cell, '|');) cells.push_back(Trim(cell));
  return cells;
}

}  // namespace

Page ReadPage(const std::filesystem::path& file) {
  std::ifstream in(file);
  Page page;
  bool fenced = false;
  for (std::string line; std::getline(in, line);) {
    const bool is_fence = Trim(line).starts_with("```");
    page.push_back(fenced || is_fence ? "" : line);
    if (is_fence) fenced = !fenced;
  }
  return page;
}

std::vector<std::string> Headings(const Page& page) {
  std::vector<std::string> headings;
  for (const std::string& line : page) {
    if (HeadingLevel(line) > 0) headings.push_back(HeadingText(line));
  }
  return headings;
}

std::set<std::string> Anchors(const Page& page) {
  std::set<std::string> anchors;
  std::map<std::string, int> seen;
  for (const std::string& heading : Headings(page)) {
    const std::string anchor = AnchorOf(heading);
    const int before = seen[anchor]++;
    anchors.insert(before == 0 ? anchor : fmt::format("{}-{}", anchor, before));
  }
  return anchors;
}

Page Section(const Page& page, const std::string& heading) {
  Page section;
  std::size_t level = 0;  // of the heading, once it was found
  for (const std::string& line : page) {
    const std::size_t here = HeadingLevel(line);
    if (level > 0 && here > 0 && here <= level) break;
    if (level > 0) section.push_back(line);
    if (level == 0 && here > 0 && HeadingText(line) == heading) level = here;
  }
  return section;
}

std::vector<TableRow> FirstTable(const Page& page) {
  std::vector<TableRow> rows;
  for (const std::string& line : page) {
    if (line.starts_with('|')) {
      rows.push_back(CellsOf(line));
    } else if (!rows.empty()) {
      break;
    }
  }
  if (rows.size() > 1) rows.erase(rows.begin() + 1);  // the line of dashes
  return rows;
}

std::vector<std::string> CodeSpans(const std::string& text) {
  std::vector<std::string> spans;
  for (std::size_t open = text.find('`'); open != std::string::npos;) {
    const std::size_t close = text.find('`', open + 1);
    if (close == std::string::npos) break;
    spans.push_back(text.substr(open + 1, close - open - 1));
    open = text.find('`', close + 1);
  }
  return spans;
}

std::vector<std::string> LinkTargets(const std::string& line) {
  const std::regex code("`[^`]*`"), target(R"(\]\(([^)\s]+)[^)]*\))");
  const std::string prose = std::regex_replace(line, code, "");
  std::vector<std::string> targets;
  for (std::sregex_iterator it(prose.begin(), prose.end(), target), end; it != end; ++it)
    targets.push_back((*it)[1]);
  return targets;
}

}  // namespace scoria::test
