// SPDX-License-Identifier: BSD-3-Clause
#include "logs/format/db3_tables.h"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/text.h"

namespace scoria::logs {
namespace {

/// Names of the tables; a view is none.
std::vector<std::string> TablesOf(const SqliteDatabase& database) {
  std::vector<std::string> names;
  SqliteQuery query =
      database.Query("SELECT name FROM sqlite_master WHERE type = 'table' AND rootpage > 0");
  query.Start();
  while (query.Next()) names.push_back(query.Text(0));
  return names;
}

std::vector<std::string> ColumnsOf(const SqliteDatabase& database, const std::string& table) {
  std::vector<std::string> names;
  SqliteQuery query = database.Query("SELECT name FROM pragma_table_info('" + table + "')");
  query.Start();
  while (query.Next()) names.push_back(query.Text(0));
  return names;
}

bool Has(const std::vector<std::string>& names, const char* name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// A column, or an empty text where a former version has none.
std::string Column(const std::vector<std::string>& columns, const char* name) {
  return Has(columns, name) ? name : "''";
}

void DemandTable(const SqliteDatabase& database, const std::vector<std::string>& tables,
                 const char* table, std::initializer_list<const char*> columns) {
  if (!Has(tables, table)) {
    std::vector<std::string> shown;
    for (const std::string& name : tables) shown.push_back(core::Shown(name));
    throw NoBagError(
        fmt::format("it has no table {} (but {})", table,
                    shown.empty() ? "none" : fmt::format("{}", fmt::join(shown, ", "))));
  }
  const std::vector<std::string> present = ColumnsOf(database, table);
  for (const char* column : columns) {
    if (!Has(present, column))
      throw NoBagError(fmt::format("its table {} has no column {}", table, column));
  }
}

/// Definitions by type and hash of the type's description.
using Definitions = std::map<std::pair<std::string, std::string>, LogSchema>;

Definitions ReadDefinitions(const SqliteDatabase& database) {
  const std::vector<std::string> columns = ColumnsOf(database, "message_definitions");
  Definitions definitions;
  SqliteQuery query = database.Query(fmt::format(
      "SELECT topic_type, {}, encoding, encoded_message_definition FROM message_definitions",
      Column(columns, "type_description_hash")));
  query.Start();
  while (query.Next()) {
    const LogSchema schema{query.Text(2), query.Text(3)};
    if (schema.encoding == "unknown") continue;  // as rosbag2 has it that found no definition
    definitions.try_emplace({query.Text(0), query.Text(1)}, schema);
  }
  return definitions;
}

/// The definition of this hash, or else the first of this type.
std::optional<LogSchema> FindDefinition(const Definitions& definitions, const std::string& type,
                                        const std::string& hash) {
  auto found = definitions.find({type, hash});
  if (found == definitions.end()) found = definitions.lower_bound({type, ""});
  if (found == definitions.end() || found->first.first != type) return std::nullopt;
  return found->second;
}

/// The last row of a table, since a recorder adds one where it could change one.
void AddLast(const SqliteDatabase& database, const char* table, const char* column, const char* key,
             LogMetadata& metadata) {
  if (!Has(ColumnsOf(database, table), column)) return;
  SqliteQuery query =
      database.Query(fmt::format("SELECT {} FROM {} ORDER BY rowid DESC LIMIT 1", column, table));
  query.Start();
  if (query.Next()) metadata[key] = query.Text(0);
}

}  // namespace

Db3Tables ReadDb3Tables(const SqliteDatabase& database) {
  const std::vector<std::string> names = TablesOf(database);
  DemandTable(database, names, "topics", {"id", "name", "type"});
  DemandTable(database, names, "messages", {"topic_id", "timestamp", "data"});
  Db3Tables tables;
  Definitions definitions;
  if (Has(names, "message_definitions")) definitions = ReadDefinitions(database);
  if (Has(names, "schema"))
    AddLast(database, "schema", "ros_distro", "ROS_DISTRO", tables.metadata);
  if (Has(names, "metadata"))
    AddLast(database, "metadata", "metadata", "serialized_metadata", tables.metadata);

  const std::vector<std::string> columns = ColumnsOf(database, "topics");
  const bool says_encoding = Has(columns, "serialization_format");
  SqliteQuery query = database.Query(
      fmt::format("SELECT id, name, type, {}, {}, {} FROM topics ORDER BY id",
                  Column(columns, "serialization_format"), Column(columns, "offered_qos_profiles"),
                  Column(columns, "type_description_hash")));
  query.Start();
  while (query.Next()) {
    LogChannel channel;
    channel.topic = query.Text(1);
    channel.type_name = query.Text(2);
    channel.message_encoding = says_encoding ? query.Text(3) : "cdr";  // there was no other then
    if (Has(columns, "offered_qos_profiles"))
      channel.metadata["offered_qos_profiles"] = query.Text(4);
    if (const std::string hash = query.Text(5); !hash.empty())
      channel.metadata["topic_type_hash"] = hash;
    channel.schema = FindDefinition(definitions, channel.type_name, query.Text(5));
    tables.channel_of_topic[query.Int(0)] = tables.channels.size();
    tables.channels.push_back(std::move(channel));
  }
  return tables;
}

}  // namespace scoria::logs
