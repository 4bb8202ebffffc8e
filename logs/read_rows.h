// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "logs/row.h"

namespace scoria::logs {

/// The rows and fall times of a log.
struct LogContent {
  std::vector<LogRow> rows;
  std::vector<double> falls_s;
  std::string problem;  // what is wrong with the file, in words
};

/// @param every keeps every n-th row.
/// A file that is no log has no rows and a problem.
[[nodiscard]] LogContent ReadLog(const std::filesystem::path& log, int every = 1);

}  // namespace scoria::logs
