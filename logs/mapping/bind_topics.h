// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/mapping/mapping.h"

namespace scoria::logs {

/// A topic of a mapping, found in a log.
struct BoundTopic {
  std::string name;                   // in the mapping
  std::string topic;                  // in the log
  std::vector<std::size_t> channels;  // in LogContents::channels: all of that topic and type
  std::vector<std::size_t> signals;   // in Mapping::signals()
  std::optional<double> max_age_s = std::nullopt;
  bool is_typed = false;  // the mapping says of which type it is
};

/// Which topics of a log a mapping reads.
struct TopicBinding {
  std::vector<BoundTopic> topics;
  std::vector<std::string> absent;  // optional topics that the log has not, by their names here
};

/// Errors: ConfigError that says which topic the log has not, or has twice.
[[nodiscard]] TopicBinding BindTopics(const Mapping& mapping, const LogContents& contents);

}  // namespace scoria::logs
