// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/bag_metadata.h"
#include "logs/format/log_source.h"

namespace scoria::logs {

/// A bag's folder, looked over.
struct BagFiles {
  std::vector<std::filesystem::path> files;  // to be read; empty: the folder is no bag
  std::filesystem::path metadata_file;       // whether or not it is there
  std::optional<BagMetadata> metadata;       // none: not there, or cannot be read
  std::vector<LogProblem> problems;
};

/// Finds the files of the bag in a folder: those that its metadata.yaml names, as it has them or
/// in the folder itself, compressed or not, and further splits of the same name; without a usable
/// metadata.yaml all .db3 and .mcap files, also with .zstd behind. Of a file that lies there
/// compressed and as it was, the latter is read.
/// Errors: std::runtime_error if .db3 and .mcap files lie side by side and nothing tells which of
/// them are the bag; std::filesystem::filesystem_error.
[[nodiscard]] BagFiles FindBagFiles(const std::filesystem::path& folder);

/// What is in a folder, "3 .csv, 1 .yaml" or "nothing".
[[nodiscard]] std::string FolderSummary(const std::filesystem::path& folder);

}  // namespace scoria::logs
