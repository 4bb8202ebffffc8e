// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "core/text.h"
#include "logs/format/csv_log.h"
#include "logs/mapping/message_reader.h"
#include "logs/ros/field_path.h"
#include "logs/ros/message_error.h"

namespace scoria::logs {
namespace {

class CsvMessageReader final : public MessageReader {
 public:
  explicit CsvMessageReader(const LogChannel& channel)
      : layout_(CsvLayoutOf(channel)), splitter_(layout_.separator) {}

  FoundField Want(const std::string& path) override { return {ColumnOf(path)}; }

  void Read(const LogMessage& message) override {
    fields_ =
        splitter_.Split({reinterpret_cast<const char*>(message.data.data()), message.data.size()});
    if (fields_.size() != layout_.columns)
      throw MessageError(
          fmt::format("a line of {} fields, not {}", fields_.size(), layout_.columns));
  }

  [[nodiscard]] std::optional<double> Number(std::size_t slot, std::size_t) const override {
    return ParseCsvNumber(fields_[slot]);
  }
  [[nodiscard]] std::optional<std::int64_t> Integer(std::size_t slot) const override {
    return ParseCsvTime(fields_[slot], 1);
  }
  [[nodiscard]] std::optional<std::int64_t> TimeNs(std::size_t slot,
                                                   std::int64_t unit_ns) const override {
    return ParseCsvTime(fields_[slot], unit_ns);
  }
  [[nodiscard]] std::vector<std::string> Texts(std::size_t slot) const override {
    return {std::string(fields_[slot])};
  }

 private:
  [[nodiscard]] std::size_t ColumnOf(const std::string& path) const {
    const auto& names = layout_.names;
    const auto named = std::find(names.begin(), names.end(), path);
    if (named != names.end()) return static_cast<std::size_t>(named - names.begin());
    std::size_t column = 0;
    const char* end = path.data() + path.size();
    const auto [stop, error] = std::from_chars(path.data(), end, column);
    const bool is_number = error == std::errc() && stop == end;
    if (is_number && column < layout_.columns) return column;
    if (is_number)
      throw FieldPathError(
          fmt::format("{}: there are {} columns, counted from 0", path, layout_.columns));
    if (names.empty())
      throw FieldPathError(fmt::format("{}: columns have no names here; they are 0 to {}",
                                       core::Shown(path), layout_.columns - 1));
    throw FieldPathError(fmt::format("there is no column \"{}\"{}", core::Shown(path),
                                     core::DidYouMean(path, names)));
  }

  CsvLayout layout_;
  CsvSplitter splitter_;
  std::span<const std::string_view> fields_;
};

}  // namespace

std::unique_ptr<MessageReader> MakeCsvReader(const LogChannel& channel) {
  return std::make_unique<CsvMessageReader>(channel);
}

}  // namespace scoria::logs
