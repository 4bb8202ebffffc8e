// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/mapping/mapping.h"
#include "logs/ros/type_resolver.h"
#include "logs/row.h"

namespace scoria::logs {

/// How one topic was read.
struct MappedTopicReport {
  std::string name, topic;  // in the mapping, in the log
  std::uint64_t num_messages = 0, num_undecodable = 0, num_late = 0;
  std::string type;   // which definition its messages follow; empty for CSV
  std::string clock;  // the choice and its evidence
  std::string first_error;
};

/// What a mapping made of a log.
struct MappingReport {
  std::string mapping;  // its name
  std::filesystem::path robot;
  std::string base_topic;  // whose messages are the rows
  std::vector<MappedTopicReport> topics;
  std::vector<std::string> absent;  // optional topics that the log has not
  std::uint64_t num_rows = 0;
  RowGroups groups;                                     // that any row has
  std::optional<std::int64_t> start_ns = std::nullopt;  // of row time 0, where that is since 1970
  bool truth_is_of_markers = false;                     // and their place on the trunk is not known
  std::vector<LogProblem> problems;                     // the log's, and what was left out of it
};

/// For reports: a line each of what was read, by which clock and definition, and what was not.
[[nodiscard]] std::string DescribeReport(const MappingReport& report);

/// Calls on_row with the rows that a mapping makes of a log, in the order of time. Two passes: the
/// first looks at all messages and decides by which clock and definition they are read. Row times
/// are in seconds; those of clocks since 1970 begin with 0 at the first row.
/// Errors: ConfigError where the mapping does not fit the log, core::FileError, and what on_row
/// throws.
MappingReport ForEachMappedRow(LogSource& log, const Mapping& mapping, const TypeResolver& resolver,
                               const std::function<void(const Row&)>& on_row);

}  // namespace scoria::logs
