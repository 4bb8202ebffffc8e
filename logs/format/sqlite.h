// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

/// SQLite's C interface with owners and exceptions, as far as bags need it.
namespace scoria::logs {

/// What SQLite refuses, in its words.
class SqliteError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A query; its database outlives it. Columns and parameters count from 0 and 1, as in SQLite.
class SqliteQuery {
 public:
  /// Begins (again) with these parameters.
  void Start(std::initializer_list<std::int64_t> parameters = {});
  /// Goes to the next row. @returns false at the end. Errors: SqliteError; then it is at its end.
  [[nodiscard]] bool Next();
  /// Of the row at hand; texts and bytes until the next call.
  [[nodiscard]] std::int64_t Int(int column) const;
  [[nodiscard]] std::string Text(int column) const;
  [[nodiscard]] std::span<const std::byte> Blob(int column) const;

 private:
  friend class SqliteDatabase;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  explicit SqliteQuery(sqlite3_stmt* statement) : statement_(statement) {}
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

class SqliteDatabase {
 public:
  enum class Mode {
    kUnchanging,  // the file alone, without -wal and -journal, and nothing is ever written
    kRecover,     // as SQLite opens its files: -wal and -journal count, and may be written back
    kCreate,      // a new file, or one that is there to be written to
  };
  /// Errors, here and below: SqliteError.
  SqliteDatabase(const std::filesystem::path& path, Mode mode);

  [[nodiscard]] SqliteQuery Query(const std::string& sql) const;
  /// Runs a query to its end.
  void Run(const std::string& sql) const;

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  std::unique_ptr<sqlite3, Close> database_;
};

}  // namespace scoria::logs
