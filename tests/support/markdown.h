// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

/// Pages in GitHub's Markdown, as far as tests read them.
namespace scoria::test {

/// A page line by line. Lines of fenced blocks are empty, so that line numbers stay right.
using Page = std::vector<std::string>;

/// Cells of a line of a table, without the bars.
using TableRow = std::vector<std::string>;

[[nodiscard]] Page ReadPage(const std::filesystem::path& file);

/// Texts of the headings.
[[nodiscard]] std::vector<std::string> Headings(const Page& page);

/// The anchors that GitHub gives the headings.
[[nodiscard]] std::set<std::string> Anchors(const Page& page);

/// What stands below a heading, up to the next one of its level or above; empty without it.
[[nodiscard]] Page Section(const Page& page, const std::string& heading);

/// The first table: its head, then its rows.
[[nodiscard]] std::vector<TableRow> FirstTable(const Page& page);

/// What stands between backticks.
[[nodiscard]] std::vector<std::string> CodeSpans(const std::string& text);

/// Targets of the links and images in a line.
[[nodiscard]] std::vector<std::string> LinkTargets(const std::string& line);

}  // namespace scoria::test
