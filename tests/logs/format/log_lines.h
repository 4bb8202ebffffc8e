// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "logs/format/log_source.h"

/// Logs as lines of text, for comparisons.
namespace scoria::logs {

using Lines = std::vector<std::string>;

/// "topic time data" of each message.
inline Lines MessagesOf(LogSource& log, const LogFilter& filter = {}) {
  Lines lines;
  log.ForEach(filter, [&](const LogMessage& m) {
    lines.push_back(
        fmt::format("{} {} {}", m.channel.topic, m.log_time_ns,
                    std::string_view(reinterpret_cast<const char*>(m.data.data()), m.data.size())));
  });
  return lines;
}

/// "file: what" of each problem, without folders.
inline Lines ProblemsOf(const LogSource& log) {
  Lines lines;
  for (const LogProblem& p : log.problems())
    lines.push_back(p.file.filename().string() + ": " + p.what);
  return lines;
}

inline std::size_t CountMessages(LogSource& log) {
  std::size_t count = 0;
  log.ForEach({}, [&](const LogMessage&) { ++count; });
  return count;
}

}  // namespace scoria::logs
