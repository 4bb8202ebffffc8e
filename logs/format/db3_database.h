// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "logs/format/log_file.h"
#include "logs/format/sqlite.h"

/// rosbag2's databases, opened without a change to the user's files.
namespace scoria::logs {

/// Whether a file is an SQLite database, by its first bytes.
[[nodiscard]] bool IsSqlite(std::span<const std::byte> head);

struct Db3Database {
  SqliteDatabase database;
  bool is_cut = false;               // the file has fewer pages than its header says
  std::vector<LogProblem> problems;  // LogFile's, and what opening met
};

/// Opens the database so that all that was committed is there, and nothing else:
/// - a -wal or -journal beside it that is not empty is applied to a copy, as SQLite does where the
///   recorder was killed; a database that is opened without its -wal lacks what is in it;
/// - of a file that is cut a copy gets the page count that it has, since SQLite refuses the file;
/// - else the file itself is read, and its -shm and empty -wal are left alone.
/// A copy is gone from its folder once it is open. Source: [SqliteFormat] sections 1.3, 3 and 4.
/// Errors: core::FileError; SqliteError if it is no database.
[[nodiscard]] Db3Database OpenDb3Database(const LogFile& file);

}  // namespace scoria::logs
