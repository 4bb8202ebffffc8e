// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/message_check.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "logs/channel_types.h"
#include "logs/format/csv_log.h"
#include "logs/mapping/clock.h"
#include "logs/mapping/message_reader.h"
#include "logs/ros/field_path.h"
#include "logs/ros/message_error.h"

namespace scoria::logs {
namespace {

/// Fields that count messages, as robots and drivers call them.
constexpr std::array kCounters = {"frame_number", "header.seq", "header.sequence_id",
                                  "field.header.seq", "tick"};
constexpr const char* kCsvStamp = "field.header.stamp";  // of rostopic echo -p, ns

/// Steps of a counter: few different ones, else it is none.
class CounterSteps {
 public:
  void Add(std::int64_t value) {
    if (last_) {
      const std::int64_t step = value - *last_;
      if (steps_.contains(step) || steps_.size() < kMost) ++steps_[step];
      ++count_;
    }
    last_ = value;
  }

  /// Steps that are larger than the usual one; nothing if most are not equal.
  struct Losses {
    std::uint64_t messages = 0, holes = 0, received = 0;
    std::int64_t largest = 0;
  };
  [[nodiscard]] std::optional<Losses> Find() const {
    if (count_ < 10) return std::nullopt;
    const auto usual =
        std::max_element(steps_.begin(), steps_.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (usual->first <= 0 || 10 * usual->second < 9 * count_) return std::nullopt;
    Losses losses;
    losses.received = count_ + 1;
    for (const auto& [step, times] : steps_) {
      if (step <= usual->first) continue;
      const std::int64_t missing = step / usual->first - 1;
      losses.messages += times * static_cast<std::uint64_t>(missing);
      losses.holes += times;
      losses.largest = std::max(losses.largest, missing);
    }
    return losses;
  }

 private:
  static constexpr std::size_t kMost = 1000;
  std::optional<std::int64_t> last_;
  std::map<std::int64_t, std::uint64_t> steps_;
  std::uint64_t count_ = 0;
};

/// The counter and the two clocks of a channel.
class ChannelCheck {
 public:
  ChannelCheck(const LogChannel& channel, const TypeChoice& type) : topic_(channel.topic) {
    const bool is_csv = channel.message_encoding == kCsvEncoding;
    if (is_csv) {
      reader_ = MakeCsvReader(channel);
    } else if (type.taken() != nullptr) {
      reader_ = MakeRosReader(type.taken()->type);
    } else {
      return;
    }
    for (const char* name : kCounters) {
      if (counter_slot_ = Want(name); counter_slot_) {
        counter_name_ = name;
        break;
      }
    }
    if (is_csv) {
      stamp_slot_ = Want(kCsvStamp);
    } else if (const auto path = StampPathOf(type.taken()->type)) {
      stamp_slot_ = Want(*path);
    }
  }

  void Add(const LogMessage& message) {
    if (!reader_ || (!counter_slot_ && !stamp_slot_)) return;
    try {
      reader_->Read(message);
    } catch (const MessageError&) {
      return;  // those who read the messages count it
    }
    if (counter_slot_) {
      if (const auto count = reader_->Integer(*counter_slot_)) counter_.Add(*count);
    }
    if (!stamp_slot_) return;
    const auto stamp_ns = reader_->TimeNs(*stamp_slot_, 1);
    if (!stamp_ns) return;
    header_.Add(*stamp_ns);
    receive_.Add(message.log_time_ns);
    const double later_s = 1e-9 * static_cast<double>(message.log_time_ns - *stamp_ns);
    least_s_ = header_.count() == 1 ? later_s : std::min(least_s_, later_s);
    most_s_ = header_.count() == 1 ? later_s : std::max(most_s_, later_s);
  }

  [[nodiscard]] std::vector<Finding> Conclude() const {
    std::vector<Finding> findings;
    if (const auto f = LostMessages()) findings.push_back(*f);
    if (const auto f = ReceiveTimes()) findings.push_back(*f);
    return findings;
  }

 private:
  std::optional<std::size_t> Want(const std::string& path) {
    try {
      return reader_->Want(path).slot;
    } catch (const FieldPathError&) {
      return std::nullopt;
    }
  }

  [[nodiscard]] std::optional<Finding> LostMessages() const {
    const auto losses = counter_.Find();
    if (!losses || losses->messages == 0) return std::nullopt;
    Finding f;
    f.severity = Severity::kWarning;
    f.kind = FindingKind::kLostMessages;
    f.signal = topic_;
    f.count = losses->messages;
    f.size = static_cast<double>(losses->messages) /
             static_cast<double>(losses->messages + losses->received);
    f.evidence =
        fmt::format("{} messages are lost by {} in {} holes, the largest of {}; {} are there",
                    f.count, counter_name_, losses->holes, losses->largest, losses->received);
    return f;
  }

  [[nodiscard]] std::optional<Finding> ReceiveTimes() const {
    const auto header = header_.Irregularity(), receive = receive_.Irregularity();
    // Times of recording that wander by half a step while the stamps do not.
    if (!header || !receive || *receive < 0.5 || *receive < 2.0 * *header) return std::nullopt;
    Finding f;
    f.severity = Severity::kWarning;
    f.kind = FindingKind::kReceiveTimes;
    f.signal = topic_;
    f.size = most_s_ - least_s_;
    f.evidence = fmt::format(
        "the stamps in the messages are regular (steps from the 5 to the 95 % quantile differ by "
        "{:.2f} of the median), the times of recording are not ({:.2f}): they are {:.4f} to {:.4f} "
        "s later",
        *header, *receive, least_s_, most_s_);
    f.repair = "mapping: time: {clock: header}";
    return f;
  }

  std::string topic_, counter_name_;
  std::unique_ptr<MessageReader> reader_;
  std::optional<std::size_t> counter_slot_, stamp_slot_;
  CounterSteps counter_;
  ClockStatistics header_, receive_;
  double least_s_ = 0.0, most_s_ = 0.0;
};

}  // namespace

std::vector<Finding> JudgeMessages(LogSource& log, const TypeResolver& resolver) {
  const LogContents& contents = log.contents();
  std::vector<TypeChoice> types = ResolveTypes(contents, resolver);
  log.ForEach({.order = LogOrder::kStored}, [&](const LogMessage& m) {
    if (!types[m.channel_index].IsSettled()) types[m.channel_index].Show(m.data);
  });
  std::vector<ChannelCheck> channels;
  for (std::size_t i = 0; i < types.size(); ++i)
    channels.emplace_back(contents.channels[i], types[i]);
  log.ForEach({.order = LogOrder::kStored},
              [&](const LogMessage& m) { channels[m.channel_index].Add(m); });
  std::vector<Finding> findings;
  for (const ChannelCheck& channel : channels) {
    for (const Finding& f : channel.Conclude()) findings.push_back(f);
  }
  return findings;
}

}  // namespace scoria::logs
