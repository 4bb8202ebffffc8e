// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "logs/format/log_source.h"

namespace scoria::logs {

/// A file that is to be opened as a log: the user's own, or what was unpacked from it. It has to be
/// there until it is open, not longer.
struct LogFile {
  std::filesystem::path shown;       // the user's, for messages
  std::filesystem::path path;        // where the bytes are
  std::vector<LogProblem> problems;  // found while it was unpacked

  explicit LogFile(std::filesystem::path file) : shown(file), path(std::move(file)) {}
  LogFile(std::filesystem::path user, std::filesystem::path unpacked, std::vector<LogProblem> found)
      : shown(std::move(user)), path(std::move(unpacked)), problems(std::move(found)) {}
};

}  // namespace scoria::logs
