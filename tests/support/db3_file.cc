// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/db3_file.h"

#include <algorithm>
#include <stdexcept>

#include <sqlite3.h>
#include <zstd.h>

namespace scoria::test {
namespace {

sqlite3* OpenDatabase(const std::filesystem::path& path) {
  sqlite3* database = nullptr;
  if (sqlite3_open(path.c_str(), &database) != SQLITE_OK)
    throw std::runtime_error(path.string() + ": " + sqlite3_errmsg(database));
  return database;
}

void Execute(sqlite3* database, const std::string& sql) {
  if (sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK)
    throw std::runtime_error(sql + ": " + sqlite3_errmsg(database));
}

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? "''" : std::string(1, c);
  return quoted + "'";
}

constexpr const char* kQos = "- history: 3\n  depth: 0\n";

}  // namespace

void Db3File::Close::operator()(sqlite3* database) const { sqlite3_close(database); }

Db3File::Db3File(const std::filesystem::path& path, Db3Era era)
    : database_(OpenDatabase(path)), era_(era) {
  std::string topic =
      "id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
      "serialization_format TEXT NOT NULL";
  if (era >= Db3Era::kQos) topic += ", offered_qos_profiles TEXT NOT NULL";
  if (era >= Db3Era::kDefinitions) topic += ", type_description_hash TEXT NOT NULL";
  Run("PRAGMA synchronous = OFF");
  if (era >= Db3Era::kMetadata) {
    Run("CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL)");
    Run("INSERT INTO schema VALUES (" + std::to_string(static_cast<int>(era)) + ", 'jazzy')");
    Run("CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, "
        "metadata TEXT NOT NULL)");
    Run("INSERT INTO metadata(metadata_version, metadata) VALUES (8, 'first'), (8, 'last')");
  }
  Run("CREATE TABLE topics(" + topic + ")");
  if (era >= Db3Era::kDefinitions)
    Run("CREATE TABLE message_definitions(id INTEGER PRIMARY KEY, topic_type TEXT NOT NULL, "
        "encoding TEXT NOT NULL, encoded_message_definition TEXT NOT NULL, "
        "type_description_hash TEXT NOT NULL)");
  Run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
      "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
  Run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
}

void Db3File::AddTopic(int id, const std::string& name, const std::string& type,
                       const std::string& encoding, const std::string& hash) {
  std::string values =
      std::to_string(id) + ", " + Quoted(name) + ", " + Quoted(type) + ", " + Quoted(encoding);
  if (era_ >= Db3Era::kQos) values += ", " + Quoted(kQos);
  if (era_ >= Db3Era::kDefinitions) values += ", " + Quoted(hash);
  Run("INSERT INTO topics VALUES (" + values + ")");
}

void Db3File::AddDefinition(const std::string& type, const std::string& encoding,
                            const std::string& text, const std::string& hash) {
  Run("INSERT INTO message_definitions(topic_type, encoding, encoded_message_definition, "
      "type_description_hash) VALUES (" +
      Quoted(type) + ", " + Quoted(encoding) + ", " + Quoted(text) + ", " + Quoted(hash) + ")");
}

void Db3File::AddMessage(int topic, std::int64_t time_ns, const std::string& data) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(database_.get(),
                     "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", -1,
                     &statement, nullptr);
  sqlite3_bind_int(statement, 1, topic);
  sqlite3_bind_int64(statement, 2, time_ns);
  sqlite3_bind_blob(statement, 3, data.data(), static_cast<int>(data.size()), SQLITE_STATIC);
  const int result = sqlite3_step(statement);
  sqlite3_finalize(statement);
  if (result != SQLITE_DONE) throw std::runtime_error(sqlite3_errmsg(database_.get()));
}

void Db3File::Run(const std::string& sql) { Execute(database_.get(), sql); }

void RunSql(const std::filesystem::path& path, const std::string& sql) {
  sqlite3* database = OpenDatabase(path);
  Execute(database, sql);
  sqlite3_close(database);
}

std::string Zstd(const std::string& content, bool says_size) {
  std::string packed(ZSTD_compressBound(content.size()) + 64, '\0');
  ZSTD_CCtx* context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, says_size ? 1 : 0);
  packed.resize(
      ZSTD_compress2(context, packed.data(), packed.size(), content.data(), content.size()));
  ZSTD_freeCCtx(context);
  return packed;
}

/// Blocks of one byte repeated. Source: [Collet2021] sections 3.1.1.1 and 3.1.1.2.
std::string ZstdBomb(std::uint64_t bytes, bool says_size) {
  constexpr std::uint64_t kBlock = 128 << 10;
  constexpr char kSizeOf8Bytes = '\xC0', kWindowOf128KiB = 7 << 3;
  std::string frame("\x28\xB5\x2F\xFD", 4);
  frame += says_size ? kSizeOf8Bytes : '\0';
  frame += kWindowOf128KiB;
  for (int i = 0; i < 8 && says_size; ++i) frame += static_cast<char>(bytes >> (8 * i));
  for (std::uint64_t done = 0; done < bytes; done += kBlock) {
    const std::uint64_t size = std::min(kBlock, bytes - done);
    const bool is_last = done + size == bytes;
    constexpr std::uint64_t kRepeated = 1;
    const std::uint64_t header = size << 3 | kRepeated << 1 | (is_last ? 1 : 0);
    for (int i = 0; i < 3; ++i) frame += static_cast<char>(header >> (8 * i));
    frame += '\0';
  }
  return frame;
}

}  // namespace scoria::test
