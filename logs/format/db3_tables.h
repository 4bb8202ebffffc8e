// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/format/sqlite.h"

/// What a bag's database says of its topics. Source: [Rosbag2], storage plugin sqlite3.
namespace scoria::logs {

/// A database that is of something else; what it lacks.
class NoBagError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Db3Tables {
  std::vector<LogChannel> channels;                      // in the order of the table
  std::map<std::int64_t, std::size_t> channel_of_topic;  // by topics.id
  LogMetadata metadata;  // ROS_DISTRO and serialized_metadata, as rosbag2's MCAP files have them
};

/// Errors: SqliteError where the database is damaged; NoBagError.
[[nodiscard]] Db3Tables ReadDb3Tables(const SqliteDatabase& database);

}  // namespace scoria::logs
