// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/csv_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>

namespace scoria::logs {
namespace {

constexpr std::string_view kBom = "\xef\xbb\xbf", kBlanks = " \t";

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) + 1 - first);
}

std::string_view WithoutSign(std::string_view text) {
  return text.starts_with('+') ? text.substr(1) : text;
}

bool IsDigits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// The first lines of a file.
struct Head {
  std::vector<std::string_view> data;  // with the header, if it is no comment
  std::string_view last_comment;       // before the first line of data, without its '#'
  std::size_t num_comments = 0;        // lines before that
};

Head ReadHead(std::string_view text, bool is_whole) {
  constexpr std::size_t kMost = 50;
  Head head;
  const bool ends_whole = text.ends_with('\n');
  if (text.starts_with(kBom)) text.remove_prefix(kBom.size());
  while (!text.empty() && head.data.size() < kMost) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos && !is_whole) break;  // cut by the end of what was read
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (IsCsvData(line)) {
      head.data.push_back(line);
      continue;
    }
    if (!head.data.empty()) continue;
    ++head.num_comments;
    const std::size_t hash = line.find('#');
    if (hash != std::string_view::npos) head.last_comment = Trimmed(line.substr(hash + 1));
  }
  // The last line of a recording may be cut.
  if (is_whole && !ends_whole && head.data.size() > 2) head.data.pop_back();
  return head;
}

using Fields = std::vector<std::string>;

Fields SplitLine(std::string_view line, char separator) {
  CsvSplitter splitter(separator);
  const auto fields = splitter.Split(line);
  return {fields.begin(), fields.end()};
}

bool HasNumber(const Fields& fields) {
  return std::any_of(fields.begin(), fields.end(),
                     [](const std::string& f) { return ParseCsvNumber(f).has_value(); });
}

/// Of so many fields at least so many are numbers.
struct Share {
  std::size_t numbers = 0, all = 0;
};

Share NumbersIn(const std::vector<Fields>& rows) {
  Share share;
  for (const Fields& row : rows) {
    for (const std::string& field : row) {
      share.numbers += field.empty() || ParseCsvNumber(field).has_value() ? 1 : 0;
      ++share.all;
    }
  }
  return share;
}

/// The rows of a text if `separator` is its; nothing if not. One line in four may be damaged.
std::optional<std::vector<Fields>> SplitAll(const Head& head, char separator) {
  std::vector<Fields> rows;
  std::map<std::size_t, std::size_t> sizes;
  for (const std::string_view line : head.data) {
    rows.push_back(SplitLine(line, separator));
    ++sizes[rows.back().size()];
  }
  if (rows.empty()) return std::nullopt;
  const auto usual = std::max_element(
      sizes.begin(), sizes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const std::size_t columns = usual->first;
  if (columns < 2 || rows.front().size() != columns || 4 * usual->second < 3 * rows.size())
    return std::nullopt;
  std::erase_if(rows, [&](const Fields& row) { return row.size() != columns; });
  return rows;
}

std::string Lower(std::string_view text) {
  std::string lower(text);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return lower;
}

/// A name of a column without the unit at its end, and the unit if it has one.
struct TimeName {
  std::string name;
  std::optional<std::int64_t> unit_ns;
};

TimeName ParseTimeName(std::string_view text) {
  struct Suffix {
    std::string_view text;
    std::int64_t unit_ns;
  };
  constexpr std::array kSuffixes = {Suffix{"_ns", 1},
                                    Suffix{"[ns]", 1},
                                    Suffix{"(ns)", 1},
                                    Suffix{"_us", 1'000},
                                    Suffix{"[us]", 1'000},
                                    Suffix{"(us)", 1'000},
                                    Suffix{"_ms", 1'000'000},
                                    Suffix{"[ms]", 1'000'000},
                                    Suffix{"(ms)", 1'000'000},
                                    Suffix{"_s", 1'000'000'000},
                                    Suffix{"[s]", 1'000'000'000},
                                    Suffix{"(s)", 1'000'000'000}};
  TimeName out{Lower(text), std::nullopt};
  for (const Suffix& s : kSuffixes) {
    if (!out.name.ends_with(s.text)) continue;
    out.name = Trimmed(std::string_view(out.name).substr(0, out.name.size() - s.text.size()));
    out.unit_ns = s.unit_ns;
    break;
  }
  return out;
}

bool MeansTime(const std::string& name) {
  const bool is_short = name == "t" || name == "sec" || name == "secs" || name == "seconds";
  return is_short || name.ends_with("time") || name.ends_with("stamp") ||
         name.starts_with("timestamp");
}

/// The unit of times since 1970 by their size, of others seconds.
std::int64_t GuessUnit(double value) {
  if (value > 1e17) return 1;
  if (value > 1e14) return 1'000;
  if (value > 1e11) return 1'000'000;
  return 1'000'000'000;
}

/// Whether a column never falls and grows as a whole, without being just the number of its line.
bool GrowsAsTime(const std::vector<Fields>& rows, std::size_t column) {
  double first = 0.0, last = 0.0;
  bool counts_lines = true;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::optional<double> value = ParseCsvNumber(rows[i][column]);
    if (!value || (i > 0 && *value < last)) return false;
    if (i == 0) first = *value;
    counts_lines = counts_lines && *value == first + static_cast<double>(i);
    last = *value;
  }
  const bool is_index = counts_lines && (first == 0.0 || first == 1.0) && rows.size() > 2;
  return rows.size() == 1 || (last > first && !is_index);
}

std::optional<CsvClock> FindClock(const std::vector<Fields>& rows, const Fields& names) {
  if (rows.empty()) return std::nullopt;
  const auto clock_of = [&](std::size_t column, std::optional<std::int64_t> unit_ns) {
    const double value = std::abs(ParseCsvNumber(rows.front()[column]).value_or(0.0));
    return CsvClock{column, unit_ns ? *unit_ns : GuessUnit(value)};
  };
  for (std::size_t column = 0; column < names.size(); ++column) {
    const TimeName name = ParseTimeName(names[column]);
    if (MeansTime(name.name) && GrowsAsTime(rows, column)) return clock_of(column, name.unit_ns);
  }
  const bool first_is_free = names.empty() || names.front().empty();
  if (first_is_free && GrowsAsTime(rows, 0)) return clock_of(0, std::nullopt);
  return std::nullopt;
}

std::optional<CsvDialect> TryDialect(const Head& head, char separator) {
  std::optional<std::vector<Fields>> rows = SplitAll(head, separator);
  if (!rows) return std::nullopt;
  CsvDialect dialect{separator, rows->front().size(), "", head.num_comments, std::nullopt};
  if (!HasNumber(rows->front())) {
    dialect.header = head.data.front();
    ++dialect.num_lead_lines;
    rows->erase(rows->begin());
  } else if (SplitLine(head.last_comment, separator).size() == dialect.columns) {
    dialect.header = head.last_comment;
  }
  const Share share = NumbersIn(*rows);
  const bool is_table =
      separator == kSpaces ? share.numbers == share.all : 2 * share.numbers >= share.all;
  if (share.all == 0 || !is_table) return std::nullopt;
  const Fields names = dialect.header.empty() ? Fields{} : SplitLine(dialect.header, separator);
  dialect.clock = FindClock(*rows, names);
  return dialect;
}

}  // namespace

std::string_view CsvSplitter::TakeQuoted(std::string_view& rest) {
  std::string text;
  bool has_inner = false;
  std::size_t at = 1;
  std::size_t close = rest.find('"', at);
  while (close != std::string_view::npos && rest.substr(close).starts_with("\"\"")) {
    text += rest.substr(at, close + 1 - at);
    has_inner = true;
    at = close + 2;
    close = rest.find('"', at);
  }
  const std::string_view last =
      rest.substr(at, close == std::string_view::npos ? close : close - at);
  rest.remove_prefix(close == std::string_view::npos ? rest.size() : close + 1);
  if (!has_inner) return last;
  return unquoted_.emplace_back(text + std::string(last));
}

std::span<const std::string_view> CsvSplitter::Split(std::string_view line) {
  fields_.clear();
  unquoted_.clear();
  const bool by_spaces = separator_ == kSpaces;
  const std::string_view ends = by_spaces ? kBlanks : std::string_view(&separator_, 1);
  std::string_view rest = by_spaces ? Trimmed(line) : line;
  for (;;) {
    const std::size_t first = rest.find_first_not_of(separator_ == '\t' ? " " : kBlanks);
    if (first != std::string_view::npos && rest[first] == '"') {
      rest.remove_prefix(first);
      fields_.push_back(TakeQuoted(rest));
      rest.remove_prefix(std::min(rest.size(), rest.find_first_of(ends)));
    } else {
      const std::size_t size = std::min(rest.size(), rest.find_first_of(ends));
      fields_.push_back(Trimmed(rest.substr(0, size)));
      rest.remove_prefix(size);
    }
    if (rest.empty()) return fields_;
    rest.remove_prefix(1);
    if (by_spaces) rest = Trimmed(rest);
  }
}

bool IsCsvData(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t\r");
  return first != std::string_view::npos && line[first] != '#';
}

std::optional<double> ParseCsvNumber(std::string_view field) {
  const std::string_view text = WithoutSign(field);
  const auto parse = [](std::string_view digits) -> std::optional<double> {
    double value = 0.0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, value);
    if (error != std::errc() || stop != end || std::isnan(value)) return std::nullopt;
    return value;
  };
  if (const std::optional<double> value = parse(text)) return value;
  if (text.size() == 4 && Lower(text) == "true") return 1.0;
  if (text.size() == 5 && Lower(text) == "false") return 0.0;
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || text.find('.') != std::string_view::npos)
    return std::nullopt;
  std::string with_point(text);
  with_point[comma] = '.';
  return parse(with_point);
}

std::optional<std::int64_t> ParseCsvTime(std::string_view field, std::int64_t unit_ns) {
  const std::string_view text = WithoutSign(field);
  const bool is_negative = text.starts_with('-');
  const std::string_view digits = is_negative ? text.substr(1) : text;
  const std::size_t point = std::min(digits.size(), digits.find_first_of(".,"));
  const std::string_view whole = digits.substr(0, point);
  const std::string_view fraction = digits.substr(std::min(digits.size(), point + 1));
  std::int64_t ns = 0;
  const auto [stop, error] = std::from_chars(whole.data(), whole.data() + whole.size(), ns);
  const bool is_plain = error == std::errc() && stop == whole.data() + whole.size() &&
                        IsDigits(fraction) && !whole.empty();
  const bool fits = is_plain && !__builtin_mul_overflow(ns, unit_ns, &ns);
  if (!fits) {
    const std::optional<double> value = ParseCsvNumber(field);
    if (!value || std::abs(*value) * static_cast<double>(unit_ns) > 9e18) return std::nullopt;
    return std::llround(*value * static_cast<double>(unit_ns));
  }
  double scale = static_cast<double>(unit_ns), rest_ns = 0.0;
  for (const char c : fraction) rest_ns += (scale /= 10.0) * (c - '0');
  ns += std::llround(rest_ns);
  return is_negative ? -ns : ns;
}

std::optional<CsvDialect> DetectCsv(std::string_view head, bool is_whole) {
  if (head.find('\0') != std::string_view::npos) return std::nullopt;
  const Head lines = ReadHead(head, is_whole);
  for (const char separator : {'\t', ';', ',', kSpaces}) {
    if (auto dialect = TryDialect(lines, separator)) return dialect;
  }
  return std::nullopt;
}

}  // namespace scoria::logs
