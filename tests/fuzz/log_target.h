// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>

#include "core/demand.h"
#include "logs/format/log_source.h"
#include "logs/format/temporary_folder.h"

/// What fuzz targets of logs have in common.
namespace scoria::test {

/// The input as a file, in a folder of its own.
class InputFile {
 public:
  explicit InputFile(std::span<const std::uint8_t> input) : path_(folder_.path() / "input") {
    std::ofstream(path_, std::ios::binary)
        .write(static_cast<const char*>(static_cast<const void*>(input.data())),
               static_cast<std::streamsize>(input.size()));
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  logs::TemporaryFolder folder_;
  std::filesystem::path path_;
};

/// Reads all of a log in an order, which it keeps unless it says what is wrong. @returns the number
/// of its messages.
inline std::uint64_t CountMessages(logs::LogSource& log, logs::LogOrder order) {
  const bool is_ordered = order == logs::LogOrder::kTime && log.contents().can_order_by_time;
  std::uint64_t count = 0, bytes = 0;
  std::int64_t last_ns = std::numeric_limits<std::int64_t>::min();
  log.ForEach({.order = order}, [&](const logs::LogMessage& m) {
    SCORIA_DEMAND(!is_ordered || m.log_time_ns >= last_ns || !log.problems().empty(), "{} {}",
                  m.log_time_ns, last_ns);
    SCORIA_DEMAND(m.channel_index < log.contents().channels.size());
    last_ns = m.log_time_ns;
    for (const std::byte b : m.data) bytes += static_cast<std::uint64_t>(b);
    ++count;
  });
  SCORIA_DEMAND(count > 0 || bytes == 0);  // so that no byte is left unread
  return count;
}

/// Whatever a log holds, both orders give the same messages, and those that it counted unless it
/// says what is wrong.
inline void ReadWhole(logs::LogSource& log) {
  const std::uint64_t by_time = CountMessages(log, logs::LogOrder::kTime);
  const std::uint64_t stored = CountMessages(log, logs::LogOrder::kStored);
  SCORIA_DEMAND(by_time == stored, "{} {}", by_time, stored);
  std::uint64_t counted = 0;
  bool all_counted = true;
  for (const logs::LogChannel& channel : log.contents().channels) {
    counted += channel.message_count.value_or(0);
    all_counted = all_counted && channel.message_count;
  }
  SCORIA_DEMAND(!all_counted || !log.problems().empty() || counted == stored, "{} {}", counted,
                stored);
  for (const std::string& name : log.contents().attachments) {
    try {
      static_cast<void>(log.ReadAttachment(name));
    } catch (const std::runtime_error&) {  // it is damaged
    }
  }
}

}  // namespace scoria::test
