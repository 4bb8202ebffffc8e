// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/format/sqlite.h"

/// Rows of a bag's table of messages. Its index of times is never used: where a database is
/// damaged the index may be, too.
namespace scoria::logs {

struct Db3Row {
  std::int64_t id = 0, topic_id = 0, time_ns = 0;
};

/// Rows that cannot be read.
struct Db3Gap {
  std::int64_t first_id = 0;
  std::optional<std::int64_t> last_id;  // none: to the end
  std::string why;
};

/// Goes through the rows as stored, or by time and, of equal times, as stored.
class Db3Rows {
 public:
  /// `database` outlives this.
  Db3Rows(const SqliteDatabase& database, LogOrder order);

  /// Nothing at the end. As stored, rows in damaged pages are passed over; by time, damage is the
  /// end.
  [[nodiscard]] std::optional<Db3Row> Next();

  /// Passed over so far.
  [[nodiscard]] const std::vector<Db3Gap>& gaps() const { return gaps_; }

 private:
  void PassOver(std::int64_t first_bad, const std::string& why);
  [[nodiscard]] std::optional<bool> HasRowFrom(std::int64_t id);

  SqliteQuery rows_, row_from_;
  bool can_pass_over_;
  std::int64_t last_id_;
  bool at_end_ = false;
  std::vector<Db3Gap> gaps_;
};

/// Reads the bytes of messages, as stored.
class Db3Data {
 public:
  explicit Db3Data(const SqliteDatabase& database);
  /// Until the next call. Errors: SqliteError if the database is damaged there.
  [[nodiscard]] std::span<const std::byte> Of(const Db3Row& row);

 private:
  SqliteQuery query_;
};

}  // namespace scoria::logs
