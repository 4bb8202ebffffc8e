// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace scoria::app {

/// A log to be analysed: one path, or several CSV files on one clock.
struct LogEntry {
  std::string id;
  std::vector<std::filesystem::path> files;
  std::string robot_hint;            // as "go2"; empty: none
  std::vector<std::string> remarks;  // of its folder
};

/// The logs that paths name. A path is a log, or an experiment folder as the reference framework's
/// recorder leaves it: bags, git-hash.txt, and param-files, which name the robot. CSV files
/// together are one log.
/// Errors: std::runtime_error for a folder that holds no log.
[[nodiscard]] std::vector<LogEntry> ListLogs(const std::vector<std::filesystem::path>& paths);

}  // namespace scoria::app
