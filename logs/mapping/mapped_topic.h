// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/mapping/bind_topics.h"
#include "logs/mapping/clock.h"
#include "logs/mapping/mapping.h"
#include "logs/mapping/message_reader.h"
#include "logs/mapping/signal_decoder.h"
#include "logs/ros/type_resolver.h"

namespace scoria::logs {

/// A message of a topic, as its mapping reads it.
struct TopicSample {
  std::int64_t receive_ns = 0;
  std::optional<std::int64_t> clock_ns;              // of the chosen clock, if the message has it
  std::vector<std::optional<SignalValues>> signals;  // by BoundTopic::signals
};

/// A topic of a log, read by a mapping: first all of its messages are shown to Scan, which decides
/// by which definition and by which clock they are read; then Decode reads them.
class MappedTopic {
 public:
  /// All are borrowed.
  MappedTopic(const Mapping& mapping, const BoundTopic& topic, const LogContents& contents,
              const TypeResolver& resolver);

  void Scan(const LogMessage& message);

  /// Errors: ConfigError for a field that the messages, as far as they were scanned, have not.
  void CheckFields() const;

  /// Ends the scan. Errors: as CheckFields, and ConfigError where there is no clock.
  void Choose();

  /// Nothing where a message cannot be decoded. In the order of the log.
  [[nodiscard]] std::optional<TopicSample> Decode(const LogMessage& message);

  [[nodiscard]] const BoundTopic& bound() const noexcept { return topic_; }
  [[nodiscard]] std::uint64_t num_messages() const noexcept { return num_messages_; }
  [[nodiscard]] std::uint64_t num_undecodable() const noexcept { return num_undecodable_; }
  [[nodiscard]] const std::string& first_error() const noexcept { return first_error_; }
  /// Why there is no definition that messages of the topic can be read by; empty if there is.
  [[nodiscard]] std::string refusal() const;
  /// Which definition the messages follow: "built in"; empty for CSV.
  [[nodiscard]] std::string DescribeType() const;
  [[nodiscard]] std::string DescribeClock() const { return DescribeClocks(clock_, Evidence()); }
  [[nodiscard]] ClockChoice clock() const noexcept { return clock_; }
  [[nodiscard]] bool has_stamps() const noexcept { return header_.count() > 0; }
  [[nodiscard]] bool has_counts() const noexcept { return counter_.count() > 0; }
  /// Typical step of the clock chosen; nothing below two messages.
  [[nodiscard]] std::optional<std::int64_t> step_ns() const;
  [[nodiscard]] std::int64_t largest_step_back_ns() const;
  /// Median of the time of recording minus that of the clock chosen.
  [[nodiscard]] std::int64_t receive_offset_ns() const;

 private:
  /// One channel of the topic: its layout may be another one.
  struct Channel {
    std::size_t index = 0;  // in LogContents::channels
    bool is_csv = false;
    std::optional<TypeChoice> type;
    const TypeCandidate* taken = nullptr;  // the reader's
    std::unique_ptr<MessageReader> reader;
    std::vector<SignalDecoder> decoders;
    std::optional<std::size_t> stamp_slot, counter_slot;
    std::exception_ptr error;  // why there are no decoders
  };
  /// What the clocks say of one message.
  struct Times {
    std::optional<std::int64_t> header_ns, counter_ns;
  };

  Channel& ChannelOf(const LogMessage& message);
  void MakeReader(Channel& channel);
  void WantSignals(Channel& channel);
  void WantClocks(Channel& channel);
  bool ReadMessage(Channel& channel, const LogMessage& message);
  [[nodiscard]] Times ReadTimes(const Channel& channel);
  [[nodiscard]] std::int64_t Unwrap(std::int64_t count);
  [[nodiscard]] std::vector<ClockEvidence> Evidence() const;
  [[nodiscard]] const ClockStatistics& StatisticsOf(ClockChoice clock) const;

  const Mapping& mapping_;
  const BoundTopic& topic_;
  const LogContents& contents_;
  PatternNames names_;
  std::deque<Channel> channels_;
  bool receive_is_time_ = true;  // not for CSV without a clock
  std::uint64_t num_messages_ = 0, num_undecodable_ = 0, row_ = 0;
  std::string first_error_;
  ClockChoice clock_ = ClockChoice::kReceive;
  ClockStatistics receive_, header_, counter_;
  Reservoir header_offset_, counter_offset_;
  bool stamps_are_since_1970_ = false;
  std::optional<std::int64_t> last_count_;
  std::int64_t wrapped_ = 0;
};

}  // namespace scoria::logs
