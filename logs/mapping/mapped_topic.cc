// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/mapped_topic.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "logs/format/csv_log.h"
#include "logs/ros/field_path.h"
#include "logs/ros/message_error.h"

namespace scoria::logs {
namespace {

std::int64_t UnitNs(TimeUnit unit) { return std::llround(ToSi(unit) * 1e9); }

PatternNames NamesOf(const MappingFile& file) {
  PatternNames names;
  names.legs = file.leg_names.value_or(file.legs);
  names.joints = file.joints.names;
  names.by_joint = file.joints.order == JointOrder::kByJoint;
  return names;
}

}  // namespace

MappedTopic::MappedTopic(const Mapping& mapping, const BoundTopic& topic,
                         const LogContents& contents, const TypeResolver& resolver)
    : mapping_(mapping), topic_(topic), contents_(contents), names_(NamesOf(mapping.file())) {
  for (const std::size_t index : topic.channels) {
    const LogChannel& from = contents.channels[index];
    Channel& channel = channels_.emplace_back();
    channel.index = index;
    channel.is_csv = from.message_encoding == kCsvEncoding;
    if (channel.is_csv) {
      receive_is_time_ = CsvLayoutOf(from).clock_column.has_value();
      MakeReader(channel);
      continue;
    }
    const LogSchema schema = from.schema.value_or(LogSchema{});
    channel.type =
        resolver.Resolve({from.type_name, from.message_encoding, schema.encoding, schema.text});
  }
}

MappedTopic::Channel& MappedTopic::ChannelOf(const LogMessage& message) {
  return *std::find_if(channels_.begin(), channels_.end(),
                       [&](const Channel& c) { return c.index == message.channel_index; });
}

void MappedTopic::MakeReader(Channel& channel) {
  channel.decoders.clear();
  channel.error = nullptr;
  channel.stamp_slot = channel.counter_slot = std::nullopt;
  channel.reader = channel.is_csv ? MakeCsvReader(contents_.channels[channel.index])
                                  : MakeRosReader(channel.taken->type);
  try {
    WantSignals(channel);
    WantClocks(channel);
  } catch (const core::ConfigError&) {
    channel.error = std::current_exception();
  }
}

void MappedTopic::WantSignals(Channel& channel) {
  for (const std::size_t i : topic_.signals) {
    const SignalSpec& spec = mapping_.signals()[i];
    try {
      channel.decoders.emplace_back(spec, names_, *channel.reader);
    } catch (const std::runtime_error& error) {  // of the path or the pattern
      throw mapping_.ErrorAt(TraitsOf(spec.id).key,
                             fmt::format("{}: {}", topic_.topic, error.what()));
    }
  }
}

void MappedTopic::WantClocks(Channel& channel) {
  const TimeSection& time = mapping_.file().time;
  const auto find = [&](const std::string& path) -> std::optional<FoundField> {
    try {
      const FoundField found = channel.reader->Want(path);
      if (found.elements == 1 && !found.is_text) return found;
    } catch (const FieldPathError&) {  // this topic has none
    }
    return std::nullopt;
  };
  if (!time.stamp.empty()) {
    if (const auto found = find(time.stamp)) channel.stamp_slot = found->slot;
  } else if (!channel.is_csv) {
    for (const char* path : {"header.stamp", "stamp"}) {
      const auto found = find(path);
      if (found && found->is_time && !channel.stamp_slot) channel.stamp_slot = found->slot;
    }
  }
  if (time.counter.empty()) return;
  if (const auto found = find(time.counter)) channel.counter_slot = found->slot;
}

bool MappedTopic::ReadMessage(Channel& channel, const LogMessage& message) {
  if (channel.reader == nullptr || channel.error != nullptr) return false;
  try {
    channel.reader->Read(message);
    return true;
  } catch (const MessageError& error) {
    if (num_undecodable_++ == 0) first_error_ = error.what();
    return false;
  }
}

void MappedTopic::Scan(const LogMessage& message) {
  ++num_messages_;
  Channel& channel = ChannelOf(message);
  if (channel.type) {
    channel.type->Show(message.data);
    const TypeCandidate* taken = channel.type->taken();
    if (taken != channel.taken) {
      channel.taken = taken;
      channel.reader.reset();
      if (taken != nullptr) MakeReader(channel);
    }
  }
  receive_.Add(message.log_time_ns);
  if (!ReadMessage(channel, message)) return;
  const Times times = ReadTimes(channel);
  if (times.header_ns) {
    if (*times.header_ns >= kYear2000_ns && !stamps_are_since_1970_) {
      stamps_are_since_1970_ = true;  // what was before was not set
      header_ = {};
      header_offset_ = {};
    }
    header_.Add(*times.header_ns);
    header_offset_.Add(message.log_time_ns - *times.header_ns);
  }
  if (times.counter_ns) {
    counter_.Add(*times.counter_ns);
    counter_offset_.Add(message.log_time_ns - *times.counter_ns);
  }
}

MappedTopic::Times MappedTopic::ReadTimes(const Channel& channel) {
  const TimeSection& time = mapping_.file().time;
  Times times;
  if (channel.stamp_slot) {
    times.header_ns = channel.reader->TimeNs(*channel.stamp_slot, UnitNs(time.stamp_unit));
    const bool is_unset =
        times.header_ns &&
        (*times.header_ns == 0 || (stamps_are_since_1970_ && *times.header_ns < kYear2000_ns));
    if (is_unset) times.header_ns.reset();
  }
  if (channel.counter_slot) {
    const auto count = channel.reader->Integer(*channel.counter_slot);
    if (count)
      times.counter_ns =
          std::llround(static_cast<double>(Unwrap(*count)) * (time.counter_period_s * 1e9));
  }
  return times;
}

/// Counters of 32 bits go on from 0.
std::int64_t MappedTopic::Unwrap(std::int64_t count) {
  constexpr std::int64_t kWrap = std::int64_t{1} << 32;
  if (last_count_ && count < *last_count_ - kWrap / 2) wrapped_ += kWrap;
  last_count_ = count;
  return count + wrapped_;
}

std::vector<ClockEvidence> MappedTopic::Evidence() const {
  std::vector<ClockEvidence> evidence;
  const auto add = [&](ClockChoice clock, const ClockStatistics& statistics) {
    ClockEvidence e{clock, statistics.count(), statistics.num_back()};
    if (const auto step = statistics.MedianStep()) e.step_s = 1e-9 * static_cast<double>(*step);
    e.irregularity = statistics.Irregularity();
    evidence.push_back(e);
  };
  // A clock that one message in ten lacks is none.
  if (10 * header_.count() >= 9 * num_messages_ && header_.count() > 0)
    add(ClockChoice::kHeader, header_);
  if (10 * counter_.count() >= 9 * num_messages_ && counter_.count() > 0)
    add(ClockChoice::kCounter, counter_);
  if (receive_is_time_) add(ClockChoice::kReceive, receive_);
  const TimeSection& time = mapping_.file().time;
  const bool by_row = time.clock == ClockChoice::kRow || evidence.empty();
  if (by_row && time.row_period_s > 0.0)
    evidence.push_back({ClockChoice::kRow, num_messages_, 0, time.row_period_s, 0.0});
  return evidence;
}

void MappedTopic::CheckFields() const {
  for (const Channel& channel : channels_) {
    if (channel.error != nullptr) std::rethrow_exception(channel.error);
  }
}

void MappedTopic::Choose() {
  CheckFields();
  const ClockChoice told = mapping_.file().time.clock;
  const std::vector<ClockEvidence> evidence = Evidence();
  std::optional<ClockChoice> chosen = ChooseClock(told, evidence);
  if (!chosen && receive_is_time_) chosen = ClockChoice::kReceive;
  if (!chosen)
    throw mapping_.ErrorAt("time", fmt::format("{}: no column grows as time does; time.stamp names "
                                               "one, or time.row_period_s is the time from row to "
                                               "row",
                                               topic_.topic));
  clock_ = *chosen;
  last_count_.reset();
  wrapped_ = 0;
  num_undecodable_ = 0;
}

std::optional<TopicSample> MappedTopic::Decode(const LogMessage& message) {
  Channel& channel = ChannelOf(message);
  const std::uint64_t row = row_++;
  if (!ReadMessage(channel, message)) return std::nullopt;
  TopicSample sample;
  sample.receive_ns = message.log_time_ns;
  const Times times = ReadTimes(channel);
  if (clock_ == ClockChoice::kHeader) sample.clock_ns = times.header_ns;
  if (clock_ == ClockChoice::kCounter) sample.clock_ns = times.counter_ns;
  if (clock_ == ClockChoice::kReceive) sample.clock_ns = message.log_time_ns;
  if (clock_ == ClockChoice::kRow)
    sample.clock_ns =
        std::llround(static_cast<double>(row) * mapping_.file().time.row_period_s * 1e9);
  sample.signals.reserve(channel.decoders.size());
  for (SignalDecoder& decoder : channel.decoders)
    sample.signals.push_back(decoder.Decode(*channel.reader));
  return sample;
}

std::string MappedTopic::refusal() const {
  for (const Channel& channel : channels_) {
    if (num_messages_ > 0 && channel.type && channel.type->taken() == nullptr)
      return channel.type->Report();
  }
  return "";
}

std::string MappedTopic::DescribeType() const {
  std::string text;
  for (const Channel& channel : channels_) {
    if (!channel.type) continue;
    text += fmt::format("{}{}", text.empty() ? "" : "; ", channel.type->Report());
  }
  return text;
}

const ClockStatistics& MappedTopic::StatisticsOf(ClockChoice clock) const {
  if (clock == ClockChoice::kHeader) return header_;
  return clock == ClockChoice::kCounter ? counter_ : receive_;
}

std::optional<std::int64_t> MappedTopic::step_ns() const {
  if (clock_ == ClockChoice::kRow) return std::llround(mapping_.file().time.row_period_s * 1e9);
  return StatisticsOf(clock_).TypicalStep();
}

std::int64_t MappedTopic::largest_step_back_ns() const {
  return clock_ == ClockChoice::kRow ? 0 : StatisticsOf(clock_).largest_step_back_ns();
}

std::int64_t MappedTopic::receive_offset_ns() const {
  const Reservoir& offset = clock_ == ClockChoice::kHeader ? header_offset_ : counter_offset_;
  const bool has_offset = clock_ == ClockChoice::kHeader || clock_ == ClockChoice::kCounter;
  return has_offset && !offset.IsEmpty() ? offset.Quantile(0.5) : 0;
}

}  // namespace scoria::logs
