// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "logs/format/bytes.h"

/// What is common to all containers of recorded messages, whatever their format. Times are in
/// nanoseconds of the recorder's clock, mostly since 1970.
namespace scoria::logs {

using LogMetadata = std::map<std::string, std::string>;

/// A file that travels in a log.
struct LogAttachment {
  std::string name, media_type;
  Bytes data;
};

/// First and last time, both included.
struct LogSpan {
  std::int64_t first_ns = 0, last_ns = 0;
  bool operator==(const LogSpan&) const = default;
};

/// How a channel's messages are laid out, as the container has it.
struct LogSchema {
  std::string encoding;  // "ros2msg", "ros2idl", "protobuf" …
  std::string text;      // bytes, where the encoding is no text
  bool operator==(const LogSchema&) const = default;
};

/// Messages of one type under one topic. Two channels can share a topic; they are two sources.
struct LogChannel {
  std::string topic;
  std::string type_name;            // "sensor_msgs/msg/Imu"; empty: the container does not say
  std::optional<LogSchema> schema;  // none: the container has no definition
  std::string message_encoding;     // "cdr", "json" …; empty: the container does not say
  LogMetadata metadata;             // such as rosbag2's "offered_qos_profiles"
  std::optional<std::uint64_t> message_count;  // none: unknown without reading everything
  std::optional<LogSpan> span;                 // likewise, and where there is no message
};

/// One message while it is read.
struct LogMessage {
  std::size_t channel_index;  // in LogContents::channels
  const LogChannel& channel;
  std::int64_t log_time_ns;                     // when it was recorded
  std::optional<std::int64_t> publish_time_ns;  // when it was sent
  std::optional<std::uint32_t> sequence;        // the sender's count
  std::span<const std::byte> data;              // until the next message is read
};

/// In which order messages come.
enum class LogOrder {
  kTime,    // of recording, by what the index says if there is one; equal times as stored
  kStored,  // as in the container; where its clock goes back, so do the messages
};

struct LogFilter {
  std::optional<std::vector<std::string>> topics = std::nullopt;  // none: all
  std::int64_t from_ns = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_ns = std::numeric_limits<std::int64_t>::max();  // included
  LogOrder order = LogOrder::kTime;

  [[nodiscard]] bool HasTopic(const std::string& topic) const;
  [[nodiscard]] bool Meets(const LogSpan& span) const {
    return span.last_ns >= from_ns && span.first_ns <= to_ns;
  }
};

/// What is wrong with a log.
struct LogProblem {
  enum class Kind {
    kCut,   // the recording ends before its file does what it announces; all before is there
    kLost,  // something within it cannot be read
    kOdd,   // wrong, but nothing is lost by it
  };
  Kind kind = Kind::kLost;
  std::filesystem::path file;
  std::string what;  // with its place, as "at byte 4711: …"
  bool operator==(const LogProblem&) const = default;
};

/// Whether any of it is more than odd.
[[nodiscard]] bool LosesData(const std::vector<LogProblem>& problems);

/// "FILE: what; FILE: what"; empty if there are none.
[[nodiscard]] std::string ProblemText(const std::vector<LogProblem>& problems);

/// What a log holds, as known without reading its messages.
struct LogContents {
  std::filesystem::path path;  // as it was opened
  std::string format;          // with its article, as "an MCAP log"
  std::vector<LogChannel> channels;
  std::optional<LogSpan> span;                  // none: no message
  bool can_order_by_time = true;                // else LogOrder::kTime, too, is the order as stored
  std::map<std::string, LogMetadata> metadata;  // by record's name; of equal names the last
  std::vector<std::string> attachments;         // their names
};

/// Reads messages one by one. Memory is bounded by what the container packs together, not by its
/// file. What cannot be read is left out and becomes one of the log's problems.
class LogCursor {
 public:
  virtual ~LogCursor() = default;
  /// Nothing at the end. Errors: core::FileError if the operating system cannot read the file.
  [[nodiscard]] virtual std::optional<LogMessage> Next() = 0;
};

/// A log that is open for reading, of whatever format. Opening is OpenLog's.
class LogSource {
 public:
  virtual ~LogSource() = default;

  [[nodiscard]] virtual const LogContents& contents() const = 0;

  /// Found so far: on opening, and by every cursor, each once.
  [[nodiscard]] virtual const std::vector<LogProblem>& problems() const = 0;

  /// The cursor lives no longer than this log.
  [[nodiscard]] virtual std::unique_ptr<LogCursor> Read(const LogFilter& filter) = 0;

  /// The first attachment of that name, if any.
  /// Errors: std::runtime_error if it is damaged.
  [[nodiscard]] virtual std::optional<LogAttachment> ReadAttachment(const std::string& name) = 0;

  /// Hands every message that the filter wants to `consume`, until that returns false if it returns
  /// anything. What it throws ends the reading and reaches the caller as it is.
  template <std::invocable<const LogMessage&> Consume>
  void ForEach(const LogFilter& filter, Consume&& consume) {
    const std::unique_ptr<LogCursor> cursor = Read(filter);
    while (const std::optional<LogMessage> message = cursor->Next()) {
      if constexpr (std::is_void_v<std::invoke_result_t<Consume, const LogMessage&>>) {
        consume(*message);
      } else if (!consume(*message)) {
        return;
      }
    }
  }
};

}  // namespace scoria::logs
