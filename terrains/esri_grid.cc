// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "core/files.h"
#include "core/text.h"
#include "terrains/height_table.h"

namespace scoria::terrains {
namespace {

std::string Lower(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// The words of a text one by one, without comments, each with its line.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {
    constexpr std::string_view kBom = "\xef\xbb\xbf";
    if (rest_.starts_with(kBom)) rest_.remove_prefix(kBom.size());
    Next();
  }
  /// Empty after the last one.
  [[nodiscard]] std::string_view word() const { return word_; }
  [[nodiscard]] int line() const { return line_; }

  void Next() {
    SkipBlanks();
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\n\v\f"), rest_.size());
    word_ = rest_.substr(0, end);
    rest_.remove_prefix(end);
  }

 private:
  void SkipBlanks() {
    while (!rest_.empty()) {
      const char c = rest_.front();
      const bool is_comment = c == '#' || c == ';' || rest_.starts_with("//");
      if (is_comment) {
        rest_.remove_prefix(std::min(rest_.find('\n'), rest_.size()));
      } else if (std::string_view(" \t\r\n\v\f").find(c) != std::string_view::npos) {
        // A line ends at LF, CRLF, or at the lone CR of old files.
        if (c == '\n' || (c == '\r' && !rest_.starts_with("\r\n"))) ++line_;
        rest_.remove_prefix(1);
      } else {
        return;
      }
    }
  }

  std::string_view rest_, word_;
  int line_ = 1;
};

/// A number as grids write it; nothing if `word` is none. "nan" and "inf" are numbers.
std::optional<double> ParseNumber(std::string_view word) {
  std::array<char, 64> text;
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || word.size() > text.size()) return std::nullopt;
  std::copy(word.begin(), word.end(), text.begin());
  char* const end = text.data() + word.size();
  const bool has_one_comma =
      std::count(text.data(), end, ',') == 1 && std::count(text.data(), end, '.') == 0;
  if (has_one_comma) std::replace(text.data(), end, ',', '.');
  std::replace_if(
      text.data() + 1, end, [](char c) { return c == 'd' || c == 'D' || c == 'E'; }, 'e');
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (stop != end) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const bool is_tiny = std::string_view(text.data(), word.size()).find("e-") != word.npos;
    return is_tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return error == std::errc{} ? std::optional(value) : std::nullopt;
}

class EsriReader {
 public:
  EsriReader(const HeightmapParams& params, std::string_view text)
      : params_(params), in_(text), text_bytes_(text.size()) {}

  HeightTable Read() {
    ReadHeader();
    HeightTable table = MakeTable();
    const auto total = table.Index(0, table.rows);
    table.heights_m.reserve(std::min(total, text_bytes_ / 2 + 1));  // whatever the header promises
    for (; !in_.word().empty() && table.heights_m.size() < total; in_.Next()) AddCell(table);
    if (table.heights_m.size() < total || !in_.word().empty()) FailCount(table);
    if (!table.cells.empty()) table.cells.resize(total);
    return table;
  }

 private:
  static constexpr std::array<std::string_view, 10> kKeys = {
      "ncols",     "nrows",    "xllcorner", "yllcorner", "xllcenter",
      "yllcenter", "cellsize", "dx",        "dy",        "nodata_value"};

  [[noreturn]] void Fail(const std::string& rule) const {
    FailHeightmap(params_, in_.line(), rule);
  }

  void ReadHeader() {
    while (!in_.word().empty() && !ParseNumber(in_.word())) {
      std::string key = Lower(in_.word());
      if (key.ends_with(':')) key.pop_back();
      if (std::find(kKeys.begin(), kKeys.end(), key) == kKeys.end()) {
        const std::vector<std::string> keys(kKeys.begin(), kKeys.end());
        Fail(fmt::format("\"{}\" is neither a height nor a key of an ESRI ASCII grid{}",
                         core::Shown(in_.word(), 30), core::DidYouMean(key, keys)));
      }
      if (header_.contains(key)) Fail(fmt::format("{} is given twice", key));
      in_.Next();
      const std::optional<double> value = ParseNumber(in_.word());
      if (!value) Fail(fmt::format("{} needs a number", key));
      header_[key] = *value;
      in_.Next();
    }
  }

  [[nodiscard]] double Required(const std::string& key) const {
    if (!header_.contains(key)) Fail(fmt::format("the header lacks {}", key));
    return header_.at(key);
  }

  [[nodiscard]] double CellSize(const char* key) const {
    const double size_m = header_.contains(key) ? header_.at(key) : Required("cellsize");
    if (!(size_m > 0.0) || !std::isfinite(size_m))
      Fail(fmt::format("a cell of {} m; it must be positive", size_m));
    return size_m;
  }

  [[nodiscard]] double Corner(const char* corner, const char* centre, double cell_m) const {
    if (header_.contains(centre)) return header_.at(centre) - 0.5 * cell_m;
    return header_.contains(corner) ? header_.at(corner) : 0.0;
  }

  HeightTable MakeTable() const {
    const double columns = Required("ncols"), rows = Required("nrows");
    for (const double count : {columns, rows}) {
      if (!(count >= 1.0) || count != std::floor(count))
        Fail(fmt::format("ncols and nrows must be whole numbers from 1 on, one is {}", count));
    }
    CheckTableSize(params_, columns, rows);
    HeightTable table;
    table.columns = static_cast<int>(columns);
    table.rows = static_cast<int>(rows);
    table.dx_m = CellSize("dx");
    table.dy_m = CellSize("dy");
    table.corner_m = {Corner("xllcorner", "xllcenter", table.dx_m),
                      Corner("yllcorner", "yllcenter", table.dy_m)};
    return table;
  }

  void AddCell(HeightTable& table) {
    const std::size_t index = table.heights_m.size();
    const std::size_t column = index % static_cast<std::size_t>(table.columns);
    if (column == 0) table.lines.push_back(in_.line());
    const std::optional<double> value = ParseNumber(in_.word());
    if (!value) {
      Fail(
          fmt::format("row {}, value {} is \"{}\"; every height must be a number, with blanks "
                      "between",
                      table.lines.size(), column + 1, core::Shown(in_.word(), 30)));
    }
    CountOnLine(table);
    table.heights_m.push_back(*value);
    const HeightTable::Cell cell = IsNoData(*value)        ? HeightTable::Cell::kNoData
                                   : std::isfinite(*value) ? HeightTable::Cell::kHeight
                                                           : HeightTable::Cell::kNotFinite;
    if (cell == HeightTable::Cell::kHeight) return;
    table.cells.resize(index + 1);
    table.cells[index] = cell;
  }

  /// NODATA is often a float that header and cells print with different digits.
  [[nodiscard]] bool IsNoData(double value) const {
    const auto found = header_.find("nodata_value");
    if (found == header_.end()) return false;
    const double no_data = found->second;
    constexpr double kFloat = 1e-6;  // six digits, as a float is printed
    return value == no_data || std::abs(value - no_data) <= kFloat * std::abs(no_data) ||
           (std::isnan(value) && std::isnan(no_data));
  }

  /// Remembers the first line that does not hold one row, if lines are rows at all.
  void CountOnLine(const HeightTable& table) {
    if (in_.line() != counted_line_) {
      CloseLine(table);
      counted_line_ = in_.line();
      on_line_ = 0;
    }
    ++on_line_;
  }

  void CloseLine(const HeightTable& table) {
    if (counted_line_ == 0) return;
    if (on_line_ == table.columns) {
      has_whole_line_ = true;
    } else if (odd_line_ == 0) {
      odd_line_ = counted_line_;
      on_odd_line_ = on_line_;
    }
  }

  [[noreturn]] void FailCount(const HeightTable& table) {
    const std::size_t total = table.Index(0, table.rows);
    const bool has_more = !in_.word().empty();
    CloseLine(table);
    std::string hint;
    if (has_whole_line_ && odd_line_ != 0 && !has_more)
      hint = fmt::format("; line {} has {} of {}", odd_line_, on_odd_line_, table.columns);
    Fail(has_more
             ? fmt::format("has more than {} x {} heights", table.columns, table.rows)
             : fmt::format("ends after {} of {} heights{}", table.heights_m.size(), total, hint));
  }

  const HeightmapParams& params_;
  Words in_;
  std::size_t text_bytes_;
  std::map<std::string, double> header_;
  int counted_line_ = 0, on_line_ = 0, odd_line_ = 0, on_odd_line_ = 0;
  bool has_whole_line_ = false;
};

}  // namespace

HeightTable ReadEsriGrid(const HeightmapParams& params) {
  const std::string text = core::ReadText(params.file);
  return EsriReader(params, text).Read();
}

}  // namespace scoria::terrains
