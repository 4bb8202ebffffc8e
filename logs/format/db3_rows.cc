// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/db3_rows.h"

#include <algorithm>
#include <limits>

namespace scoria::logs {
namespace {

using Limits = std::numeric_limits<std::int64_t>;

const std::string kColumns = "SELECT rowid, topic_id, timestamp FROM messages NOT INDEXED ";

std::string RowsSql(LogOrder order) {
  return kColumns + (order == LogOrder::kTime ? "ORDER BY timestamp, rowid"
                                              : "WHERE rowid >= ?1 ORDER BY rowid");
}

}  // namespace

Db3Rows::Db3Rows(const SqliteDatabase& database, LogOrder order)
    : rows_(database.Query(RowsSql(order))),
      row_from_(database.Query(kColumns + "WHERE rowid >= ?1 ORDER BY rowid LIMIT 1")),
      can_pass_over_(order == LogOrder::kStored),
      last_id_(Limits::min()) {
  if (can_pass_over_) {
    rows_.Start({Limits::min()});
  } else {
    rows_.Start();
  }
}

std::optional<Db3Row> Db3Rows::Next() {
  while (!at_end_) {
    const std::int64_t next_id = last_id_ == Limits::min() ? last_id_ : last_id_ + 1;
    try {
      if (!rows_.Next()) break;
      const Db3Row row{rows_.Int(0), rows_.Int(1), rows_.Int(2)};
      // Pages that are linked in a circle would give the same rows for ever.
      if (can_pass_over_ && row.id < next_id) throw SqliteError("its pages are out of order");
      if (row.id == Limits::max()) at_end_ = true;
      last_id_ = row.id;
      return row;
    } catch (const SqliteError& e) {
      PassOver(next_id, e.what());
    }
  }
  at_end_ = true;
  return std::nullopt;
}

/// Finds where rows can be read again: by steps that double, then back by halves. Each look goes
/// down the tree of pages, so that it meets few others.
void Db3Rows::PassOver(std::int64_t first_bad, const std::string& why) {
  constexpr std::size_t kMostGaps = 1000;  // so that a database that is all holes comes to an end
  gaps_.push_back({first_bad, std::nullopt, why});
  at_end_ = true;
  if (!can_pass_over_ || gaps_.size() > kMostGaps) return;
  std::int64_t bad = std::max<std::int64_t>(first_bad, 0), step = 1;
  if (bad == Limits::max()) return;
  while (!HasRowFrom(bad + step)) {
    bad += step;
    if (bad > Limits::max() - 2 * step || step > Limits::max() / 4) return;
    step *= 2;
  }
  std::int64_t good = bad + step;
  while (good - bad > 1) {
    const std::int64_t middle = bad + (good - bad) / 2;
    (HasRowFrom(middle) ? good : bad) = middle;
  }
  if (!*HasRowFrom(good)) return;
  gaps_.back().last_id = good - 1;
  last_id_ = good - 1;
  at_end_ = false;
  rows_.Start({good});
}

/// Nothing where the database is damaged.
std::optional<bool> Db3Rows::HasRowFrom(std::int64_t id) {
  try {
    row_from_.Start({id});
    return row_from_.Next();
  } catch (const SqliteError&) {
    return std::nullopt;
  }
}

Db3Data::Db3Data(const SqliteDatabase& database)
    : query_(database.Query("SELECT data FROM messages NOT INDEXED WHERE rowid = ?1")) {}

std::span<const std::byte> Db3Data::Of(const Db3Row& row) {
  query_.Start({row.id});
  if (!query_.Next()) throw SqliteError("the row is gone");
  return query_.Blob(0);
}

}  // namespace scoria::logs
