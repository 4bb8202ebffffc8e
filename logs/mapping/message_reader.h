// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/log_source.h"
#include "logs/ros/message_type.h"

namespace scoria::logs {

/// What a path or column name means in the messages of a channel.
struct FoundField {
  std::size_t slot = 0;      // for the functions below
  std::size_t elements = 1;  // numbers or texts; 0: as many as a message has
  bool is_time = false;
  bool is_text = false;
};

/// Reads chosen fields of the messages of one channel.
class MessageReader {
 public:
  virtual ~MessageReader() = default;

  /// Looks a field up and reads it from now on. Errors: FieldPathError.
  virtual FoundField Want(const std::string& path) = 0;

  /// Errors: MessageError.
  virtual void Read(const LogMessage& message) = 0;

  /// Of the last message. Absent: it has none there, or NaN.
  [[nodiscard]] virtual std::optional<double> Number(std::size_t slot,
                                                     std::size_t element) const = 0;
  /// A whole number, such as a counter, exactly.
  [[nodiscard]] virtual std::optional<std::int64_t> Integer(std::size_t slot) const = 0;
  /// A time in ns: of a field that is one, or of a number of that unit.
  [[nodiscard]] virtual std::optional<std::int64_t> TimeNs(std::size_t slot,
                                                           std::int64_t unit_ns) const = 0;
  [[nodiscard]] virtual std::vector<std::string> Texts(std::size_t slot) const = 0;
};

/// @param type  must outlive the reader.
[[nodiscard]] std::unique_ptr<MessageReader> MakeRosReader(const MessageType& type);

/// @pre channel.message_encoding is kCsvEncoding.
[[nodiscard]] std::unique_ptr<MessageReader> MakeCsvReader(const LogChannel& channel);

}  // namespace scoria::logs
