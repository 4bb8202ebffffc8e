// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/csv_text.h"
#include "logs/format/log_source.h"

namespace scoria::logs {

/// The encoding of messages, and of schemas, of CSV files.
inline constexpr std::string_view kCsvEncoding = "csv";

/// How to read the messages of a channel of a CSV log; its schema and metadata hold it.
struct CsvLayout {
  char separator = ',';
  std::vector<std::string> names;  // of the columns; empty: there is no header
  std::size_t columns = 0;
  std::optional<std::size_t> clock_column;  // none: log times are the numbers of lines, in ns
};

/// @pre channel.message_encoding is kCsvEncoding.
[[nodiscard]] CsvLayout CsvLayoutOf(const LogChannel& channel);

/// The channel of a table, without its messages.
[[nodiscard]] LogChannel MakeCsvChannel(const std::string& topic, const CsvDialect& dialect);

/// Whether a file is a table of numbers, by its content.
/// Errors, here and below: core::FileError.
[[nodiscard]] bool IsCsv(const std::filesystem::path& path);

/// The tables of numbers among the .csv files of a folder, by name; none where a bag is beside
/// them.
[[nodiscard]] std::vector<std::filesystem::path> CsvFilesIn(const std::filesystem::path& folder);

/// Opens CSV files as one log: a channel for each, named as the file without its extension, a
/// message for each line of data. Separators are commas, semicolons, tabs or spaces; the first line
/// or the last comment before the data may name the columns. The time of a message is that of the
/// first column that grows as time does and is called so, or is the first and has no name; else it
/// is the line's number. Lines of several files come in the order of their times.
/// Errors: std::runtime_error that names a file that is no table of numbers, and two files of one
/// name.
[[nodiscard]] std::unique_ptr<LogSource> OpenCsv(const std::vector<std::filesystem::path>& paths);

}  // namespace scoria::logs
