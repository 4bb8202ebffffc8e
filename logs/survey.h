// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/ros/type_resolver.h"

namespace scoria::logs {

/// Steps of a clock within this share of their median are regular.
inline constexpr double kRegularWithin = 0.1;

/// What one clock says of the messages of a channel, in the order in which the log stores them.
struct ClockSurvey {
  std::uint64_t stamps = 0;
  std::optional<LogSpan> span;          // earliest and latest; none: no stamp
  std::uint64_t backward = 0;           // stamps earlier than the one before them
  std::uint64_t repeated = 0;           // stamps equal to the one before them
  std::optional<double> median_step_s;  // of steps forward; none: there is none
  double longest_step_s = 0.0;          // likewise
  std::optional<double> regular_share;  // of all steps; none: fewer than two stamps

  /// By the median step.
  [[nodiscard]] std::optional<double> rate_Hz() const;
};

/// By how much the first clock is later than the second.
struct ClockDifference {
  double median_s = 0.0, smallest_s = 0.0, largest_s = 0.0;
};

/// What the messages of a channel turned out to be.
struct ChannelSurvey {
  explicit ChannelSurvey(TypeChoice choice) : type(std::move(choice)) {}

  std::uint64_t messages = 0, bytes = 0;
  ClockSurvey receive;  // when they were recorded
  /// The time in the messages; none where they have none, or are not decoded.
  std::optional<ClockSurvey> header;
  std::string header_path;  // where that is, as "header.stamp"
  std::optional<ClockDifference> receive_after_header;
  bool is_table = false;        // of a CSV file: columns, no type
  TypeChoice type;              // every message was shown to it; none that is a table's
  std::uint64_t undecoded = 0;  // messages that do not fit what is taken; all, if nothing is
  std::string first_undecoded;  // why, where something is taken

  [[nodiscard]] bool IsDecoded() const noexcept { return is_table || type.taken() != nullptr; }
};

/// What a log holds, as read to its end.
struct LogSurvey {
  std::vector<ChannelSurvey> channels;  // as LogContents::channels
  std::uint64_t messages = 0;
  std::optional<LogSpan> span;  // by the receive clock
};

/// Reads a log once, in the order in which it is stored. Memory does not grow with its length.
/// Errors: core::FileError.
[[nodiscard]] LogSurvey SurveyLog(LogSource& log, const TypeResolver& resolver);

}  // namespace scoria::logs
