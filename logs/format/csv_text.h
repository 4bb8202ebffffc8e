// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What the text of a CSV file means: fields, numbers, times, and how to tell which dialect it is.
namespace scoria::logs {

/// The separator of files whose columns stand apart by any number of spaces.
inline constexpr char kSpaces = ' ';

/// The column that holds the time, and its unit.
struct CsvClock {
  std::size_t column = 0;
  std::int64_t unit_ns = 1'000'000'000;
  bool operator==(const CsvClock&) const = default;
};

struct CsvDialect {
  char separator = ',';
  std::size_t columns = 0;
  std::string header;              // the line of names; empty: there is none
  std::size_t num_lead_lines = 0;  // before the first line of data: comments, header
  std::optional<CsvClock> clock;
  bool operator==(const CsvDialect&) const = default;
};

/// Splits lines at a separator. Fields may stand in double quotes, within which two of them are
/// one; no field goes on in the next line.
class CsvSplitter {
 public:
  explicit CsvSplitter(char separator) : separator_(separator) {}

  /// The fields of a line without its end, blanks around them left out; until the next call.
  std::span<const std::string_view> Split(std::string_view line);

 private:
  std::string_view TakeQuoted(std::string_view& rest);

  char separator_;
  std::vector<std::string_view> fields_;
  std::deque<std::string> unquoted_;  // of fields with quotes inside
};

/// A line that is neither empty nor a comment.
[[nodiscard]] bool IsCsvData(std::string_view line);

/// A number; true is 1, false 0. A comma is a decimal point where it does not separate fields.
/// Nothing for other text, and for NaN.
[[nodiscard]] std::optional<double> ParseCsvNumber(std::string_view field);

/// A time in ns, exact to the digits given.
[[nodiscard]] std::optional<std::int64_t> ParseCsvTime(std::string_view field,
                                                       std::int64_t unit_ns);

/// Which dialect a text is of, by its first lines; nothing if it is no table of numbers.
/// @param head      the beginning of the file.
/// @param is_whole  that it is all of it.
[[nodiscard]] std::optional<CsvDialect> DetectCsv(std::string_view head, bool is_whole);

}  // namespace scoria::logs
