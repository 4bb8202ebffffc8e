// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/mapped_log.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

namespace scoria::logs {

MappedLog::MappedLog(LogSource& log, const Mapping& mapping, const TypeResolver& resolver)
    : binding_(BindTopics(mapping, log.contents())) {
  std::erase_if(binding_.topics, [](const BoundTopic& topic) { return topic.signals.empty(); });
  for (const BoundTopic& topic : binding_.topics)
    topics_.emplace_back(mapping, topic, log.contents(), resolver);
  FindBase(mapping);
  log.ForEach(Filter(), [&](const LogMessage& message) {
    if (const auto topic = TopicOf(message.channel_index)) topics_[*topic].Scan(message);
  });
  for (const MappedTopic& topic : topics_) topic.CheckFields();
  CheckClocks(mapping);
  for (MappedTopic& topic : topics_) {
    topic.Choose();
    receive_offsets_ns_.push_back(topic.receive_offset_ns());
  }
}

/// A clock that the mapping names is in the messages.
void MappedLog::CheckClocks(const Mapping& mapping) const {
  const TimeSection& time = mapping.file().time;
  const auto none = [&](bool (MappedTopic::*has)() const noexcept) {
    return std::none_of(topics_.begin(), topics_.end(),
                        [&](const MappedTopic& topic) { return (topic.*has)(); });
  };
  const std::string& base = topics_[base_].bound().topic;
  if (topics_[base_].num_messages() == 0) return;
  if (!time.stamp.empty() && none(&MappedTopic::has_stamps))
    throw mapping.ErrorAt("time.stamp", fmt::format("no topic has times in \"{}\"", time.stamp));
  if (!time.counter.empty() && none(&MappedTopic::has_counts))
    throw mapping.ErrorAt("time.counter",
                          fmt::format("no topic has counts in \"{}\"", time.counter));
  if (time.clock == ClockChoice::kHeader && !topics_[base_].has_stamps())
    throw mapping.ErrorAt("time.clock", fmt::format("{} has no header stamps", base));
  if (time.clock == ClockChoice::kCounter && !topics_[base_].has_counts())
    throw mapping.ErrorAt("time.clock", fmt::format("{} has no counter", base));
}

LogFilter MappedLog::Filter() const {
  LogFilter filter;
  filter.topics.emplace();
  for (const BoundTopic& topic : binding_.topics) filter.topics->push_back(topic.topic);
  return filter;
}

std::optional<std::size_t> MappedLog::TopicOf(std::size_t channel_index) const {
  for (std::size_t i = 0; i < binding_.topics.size(); ++i) {
    const auto& channels = binding_.topics[i].channels;
    if (std::find(channels.begin(), channels.end(), channel_index) != channels.end()) return i;
  }
  return std::nullopt;
}

/// The topic that the mapping names, else that of the joints, else that of the first signal.
void MappedLog::FindBase(const Mapping& mapping) {
  const std::string& named = mapping.file().base_topic;
  if (topics_.empty())
    throw mapping.ErrorAt("topics", "the log has none of the optional topics either");
  std::size_t first_signal = mapping.signals().size();
  for (std::size_t i = 0; i < binding_.topics.size(); ++i) {
    const BoundTopic& topic = binding_.topics[i];
    if (!named.empty() && (topic.name == named || topic.topic == named)) {
      base_ = i;
      return;
    }
    if (topic.signals.front() >= first_signal) continue;
    first_signal = topic.signals.front();
    base_ = i;
  }
}

std::int64_t MappedLog::TimeOf(std::size_t topic, const TopicSample& sample) const {
  // Clocks of other machines, or since another start, are joined by the times of recording.
  constexpr std::int64_t kOtherClock_ns = 10'000'000'000;
  const bool by_header = topics_[base_].clock() == ClockChoice::kHeader;
  const std::int64_t base_offset_ns = by_header ? receive_offsets_ns_[base_] : 0;
  if (!sample.clock_ns) return sample.receive_ns - base_offset_ns;
  const MappedTopic& own = topics_[topic];
  const std::int64_t offset_ns = receive_offsets_ns_[topic];
  const bool is_same_clock = by_header && own.clock() == ClockChoice::kHeader &&
                             std::abs(offset_ns - base_offset_ns) < kOtherClock_ns;
  return is_same_clock ? *sample.clock_ns : *sample.clock_ns + offset_ns - base_offset_ns;
}

}  // namespace scoria::logs
