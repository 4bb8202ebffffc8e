// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/choose_mapping.h"

#include <optional>
#include <vector>

#include <fmt/format.h>

#include "logs/format/csv_log.h"
#include "logs/mapping/bind_topics.h"
#include "logs/mapping/mapped_topic.h"

namespace scoria::logs {
namespace {

/// How many signals a mapping gives; nothing if it does not fit. Columns of CSV files are looked
/// up; of messages the type must be given, and is enough.
std::optional<std::size_t> CountSignals(const Mapping& mapping, const LogContents& contents,
                                        const TypeResolver& resolver) {
  try {
    const TopicBinding binding = BindTopics(mapping, contents);
    std::size_t count = 0;
    for (const BoundTopic& topic : binding.topics) {
      count += topic.signals.size();
      const bool is_csv =
          contents.channels[topic.channels.front()].message_encoding == kCsvEncoding;
      if (!is_csv && !topic.is_typed) return std::nullopt;
      if (is_csv) MappedTopic(mapping, topic, contents, resolver).CheckFields();
    }
    if (count == 0) return std::nullopt;
    return count;
  } catch (const core::ConfigError&) {  // it is for other logs
    return std::nullopt;
  }
}

}  // namespace

const Mapping& ChooseMapping(const LogContents& contents, std::span<const Mapping> mappings) {
  std::vector<const Mapping*> best;
  std::vector<std::string> names;
  std::size_t most = 0;
  const TypeResolver resolver;
  for (const Mapping& mapping : mappings) {
    names.push_back(mapping.name());
    const std::optional<std::size_t> count = CountSignals(mapping, contents, resolver);
    if (!count || *count < most) continue;
    if (*count > most) best.clear();
    most = *count;
    best.push_back(&mapping);
  }
  if (best.size() == 1) return *best.front();
  if (best.empty())
    throw MappingChoiceError(
        fmt::format("{}: none of the mappings {} fits its topics, types and columns; write one "
                    "(docs/mappings.md) or draft one: scoria info LOG --draft-mapping FILE",
                    contents.path.string(), fmt::join(names, ", ")));
  throw MappingChoiceError(fmt::format("{}: the mappings {} and {} fit equally; say which",
                                       contents.path.string(), best[0]->name(), best[1]->name()));
}

}  // namespace scoria::logs
