// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/sqlite.h"

#include <cctype>

#include <fmt/format.h>
#include <sqlite3.h>

namespace scoria::logs {
namespace {

/// As a URI that SQLite understands, whatever characters are in the path.
std::string ToUri(const std::filesystem::path& path) {
  std::string uri = "file:";
  for (const char c : path.string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) != 0 || c == '/' || c == '.' || c == '_' || c == '-';
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return uri;
}

}  // namespace

void SqliteQuery::Finalize::operator()(sqlite3_stmt* statement) const {
  sqlite3_finalize(statement);
}

void SqliteQuery::Start(std::initializer_list<std::int64_t> parameters) {
  sqlite3_reset(statement_.get());
  int at = 0;
  for (const std::int64_t parameter : parameters)
    sqlite3_bind_int64(statement_.get(), ++at, parameter);
}

bool SqliteQuery::Next() {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE) return false;
  SqliteError error(sqlite3_errmsg(sqlite3_db_handle(statement_.get())));
  sqlite3_reset(statement_.get());
  throw error;
}

std::int64_t SqliteQuery::Int(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string SqliteQuery::Text(int column) const {
  const unsigned char* text = sqlite3_column_text(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return {reinterpret_cast<const char*>(text),
          text == nullptr ? 0 : static_cast<std::size_t>(size)};
}

std::span<const std::byte> SqliteQuery::Blob(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return {static_cast<const std::byte*>(data),
          data == nullptr ? 0 : static_cast<std::size_t>(size)};
}

void SqliteDatabase::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

SqliteDatabase::SqliteDatabase(const std::filesystem::path& path, Mode mode) {
  constexpr int kLargestValue = 1 << 28;  // no message is larger
  int flags = SQLITE_OPEN_READONLY;
  if (mode != Mode::kUnchanging) flags = SQLITE_OPEN_READWRITE;
  if (mode == Mode::kCreate) flags |= SQLITE_OPEN_CREATE;
  const std::string uri =
      ToUri(std::filesystem::absolute(path)) + (mode == Mode::kUnchanging ? "?immutable=1" : "");
  sqlite3* database = nullptr;
  const int result = sqlite3_open_v2(uri.c_str(), &database, flags | SQLITE_OPEN_URI, nullptr);
  database_.reset(database);
  if (result != SQLITE_OK) throw SqliteError(sqlite3_errstr(result));
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kLargestValue);
  // A bag is data: what a file brings along of functions and triggers is not run.
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
}

SqliteQuery SqliteDatabase::Query(const std::string& sql) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr) != SQLITE_OK)
    throw SqliteError(sqlite3_errmsg(database_.get()));
  return SqliteQuery(statement);
}

void SqliteDatabase::Run(const std::string& sql) const {
  SqliteQuery query = Query(sql);
  while (query.Next()) {
  }
}

}  // namespace scoria::logs
