// SPDX-License-Identifier: BSD-3-Clause
#include "logs/row_joiner.h"

#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "logs/messages/read_messages.h"

namespace scoria::logs {
namespace {

/// The first line in which a schema differs from ours.
std::string DescribeDifference(const std::string& theirs, const std::string& ours) {
  std::istringstream their_lines(theirs), our_lines(ours);
  for (;;) {
    std::string a, b;
    const bool more_a = static_cast<bool>(std::getline(their_lines, a));
    const bool more_b = static_cast<bool>(std::getline(our_lines, b));
    if (!more_a && !more_b) return "its schema has other ends of lines";
    if (more_a && more_b && a == b) continue;
    if (!more_a) return fmt::format("it lacks \"{}\"", b);
    if (!more_b) return fmt::format("it has \"{}\", which this version does not know", a);
    return fmt::format("it has \"{}\" where this version has \"{}\"", a, b);
  }
}

}  // namespace

RowJoiner::RowJoiner(OnRow on_row) : on_row_(std::move(on_row)) {
  ForEachGroup(row_, [this]<class Group>(std::optional<Group>&) {
    decoders_[TopicOf(Group::kGroup)] = {
        SchemaWriter::SchemaOf<RowMessage<Group>>(), [](const LogMessage& from, Row& row) {
          auto message = Decode<RowMessage<Group>>(from);
          row.time_s = message.time_s;
          ForEachGroup(row, [&]<class Other>(std::optional<Other>& group) {
            if constexpr (std::is_same_v<Other, Group>) group = std::move(message.group);
          });
        }};
  });
}

bool RowJoiner::Add(const LogMessage& message) {
  const std::string& topic = message.channel.topic;
  const auto decoder = decoders_.find(topic);
  if (decoder == decoders_.end()) {
    const bool whole_row = topic + "/" == kRowTopics;
    if (whole_row) {
      refused_.try_emplace(
          topic,
          "rows in one message, as version 0.1.0 wrote them, are not read; walk its "
          "scenario again");
    } else if (topic.starts_with(kRowTopics)) {
      refused_.try_emplace(topic, "this version does not know it");
    }
    return whole_row || topic.starts_with(kRowTopics);
  }
  const std::string theirs = message.channel.schema ? message.channel.schema->text : "";
  if (message.channel.message_encoding != "cdr") {
    refused_.try_emplace(topic, fmt::format("its encoding is \"{}\", not \"cdr\"",
                                            message.channel.message_encoding));
  } else if (theirs != decoder->second.schema_text) {
    refused_.try_emplace(topic, DescribeDifference(theirs, decoder->second.schema_text));
  } else {
    Begin(message.log_time_ns);
    decoder->second.decode(message, row_);
  }
  return true;
}

void RowJoiner::Begin(std::int64_t time_ns) {
  if (time_ns_ == time_ns) return;
  if (time_ns_ && time_ns < *time_ns_ && !goes_back_s_)
    goes_back_s_ = static_cast<double>(time_ns) * 1e-9;
  Finish();
  time_ns_ = time_ns;
}

void RowJoiner::Finish() {
  if (time_ns_) on_row_(row_);
  time_ns_.reset();
  row_ = {};
}

}  // namespace scoria::logs
