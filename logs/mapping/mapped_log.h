// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "logs/mapping/mapped_topic.h"

namespace scoria::logs {

/// A log as a mapping reads it, after a pass over its messages.
class MappedLog {
 public:
  /// Reads all messages of the mapping's topics once. All are borrowed.
  /// Errors: ConfigError where the mapping does not fit the log; core::FileError.
  MappedLog(LogSource& log, const Mapping& mapping, const TypeResolver& resolver);
  MappedLog(const MappedLog&) = delete;
  MappedLog& operator=(const MappedLog&) = delete;

  [[nodiscard]] const TopicBinding& binding() const noexcept { return binding_; }
  [[nodiscard]] std::deque<MappedTopic>& topics() noexcept { return topics_; }
  [[nodiscard]] std::size_t base() const noexcept { return base_; }  // of topics()

  /// Where a sample of a topic is on the clock that all are joined by: the base topic's.
  [[nodiscard]] std::int64_t TimeOf(std::size_t topic, const TopicSample& sample) const;

  /// The topic that a channel of the log is of; nothing if the mapping does not read it.
  [[nodiscard]] std::optional<std::size_t> TopicOf(std::size_t channel_index) const;

  /// The messages that the mapping reads.
  [[nodiscard]] LogFilter Filter() const;

 private:
  void FindBase(const Mapping& mapping);
  void CheckClocks(const Mapping& mapping) const;

  TopicBinding binding_;
  std::deque<MappedTopic> topics_;
  std::vector<std::int64_t> receive_offsets_ns_;  // by topic
  std::size_t base_ = 0;
};

}  // namespace scoria::logs
