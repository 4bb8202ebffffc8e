// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "logs/format/log_source.h"
#include "logs/row.h"

namespace scoria::logs {

/// Joins the groups of one instant, as a log holds them, to rows. Keeps one row at a time.
class RowJoiner {
 public:
  using OnRow = std::function<void(const Row&)>;

  /// @param on_row  called with every row, once the next one begins or Finish is called.
  explicit RowJoiner(OnRow on_row);

  /// Takes a message of any topic. A group whose schema is not this version's stays absent.
  /// @returns false if it belongs to no row.
  /// Errors: DecodeError if the message is damaged.
  bool Add(const LogMessage& message);

  /// Ends the last row.
  void Finish();

  /// The row of the newest instant, as far as it has come.
  [[nodiscard]] const Row& row() const noexcept { return row_; }

  /// Topics of rows that are not decoded, and why, in words.
  [[nodiscard]] const std::map<std::string, std::string>& refused() const noexcept {
    return refused_;
  }
  /// The first moment at which the rows go back in time; they are handed on as they come.
  [[nodiscard]] std::optional<double> goes_back_s() const noexcept { return goes_back_s_; }

 private:
  struct Decoder {
    std::string schema_text;
    void (*decode)(const LogMessage& message, Row& row);
  };
  void Begin(std::int64_t time_ns);

  OnRow on_row_;
  std::map<std::string, Decoder> decoders_;  // by topic
  std::map<std::string, std::string> refused_;
  std::optional<double> goes_back_s_;
  Row row_;
  std::optional<std::int64_t> time_ns_;  // of the open row
};

}  // namespace scoria::logs
