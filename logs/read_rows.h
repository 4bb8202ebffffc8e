// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/row.h"
#include "logs/row_joiner.h"

namespace scoria::logs {

/// Name of the metadata record that names the layout of the rows and who wrote them.
inline constexpr const char* kRowMetadata = "scoria_rows";

/// That record. @param version  of the program that writes it.
[[nodiscard]] std::map<std::string, std::string> MakeRowMetadata(const std::string& version);

/// @returns why the rows of a log cannot be read, in words, if it names another layout than
/// kRowSchemaVersion; empty if not.
[[nodiscard]] std::string DescribeOtherLayout(const LogSource& log);

/// @returns which groups `joiner` left out of the log that it read to its end, who wrote them and
/// why they are left out, in words; empty if it read all.
[[nodiscard]] std::string DescribeRowProblems(const LogSource& log, const RowJoiner& joiner);

/// Calls on_row with every row of a log, in the order of the log. Memory does not grow with the
/// log.
/// @returns what is wrong with it, in words; empty if nothing. A group that another version laid
/// out differently is absent from all rows, and named here.
[[nodiscard]] std::string ForEachRow(const std::filesystem::path& log,
                                     const std::function<void(const Row&)>& on_row);

/// The rows and fall times of a log.
struct LogContent {
  std::vector<Row> rows;
  std::vector<double> falls_s;
  std::string problem;  // what is wrong with the file, in words
};

/// @param every keeps every n-th row.
/// A file that is no log has no rows and a problem.
[[nodiscard]] LogContent ReadLog(const std::filesystem::path& log, int every = 1);

}  // namespace scoria::logs
