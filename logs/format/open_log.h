// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "logs/format/log_source.h"

namespace scoria::logs {

/// Opens a log of any format that scoria reads, chosen by its content, never by its name: an MCAP
/// file, one file of a rosbag2 bag, each also packed by zstd; or a whole bag, by its folder or the
/// metadata.yaml in it.
/// Errors: std::runtime_error that names the file and says what it is if it is no such log;
/// core::FileError if it cannot be read.
[[nodiscard]] std::unique_ptr<LogSource> OpenLog(const std::filesystem::path& path);

/// Opens several CSV files on one clock as one log. @pre there is at least one path.
/// Errors: as above, and std::runtime_error for several files that are not all CSV.
[[nodiscard]] std::unique_ptr<LogSource> OpenLog(const std::vector<std::filesystem::path>& paths);

}  // namespace scoria::logs
