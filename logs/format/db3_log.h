// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "logs/format/log_file.h"
#include "logs/format/log_source.h"

namespace scoria::logs {

/// Opens one file of a rosbag2 bag of the sqlite3 storage. What it holds is seen from its tables
/// and their columns, never from a version number:
///   topics(id, name, type [, serialization_format [, offered_qos_profiles
///          [, type_description_hash]]]), messages(id, topic_id, timestamp, data),
///   and maybe message_definitions, schema, metadata.
/// All rows are counted on opening, since no index tells how many there are of each topic.
/// Files are left unchanged; see OpenDb3Database for those of killed recorders and cut ones.
/// Errors: core::FileError; std::runtime_error if it is a database but no bag.
[[nodiscard]] std::unique_ptr<LogSource> OpenDb3(const LogFile& file);

}  // namespace scoria::logs
