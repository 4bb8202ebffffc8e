// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "logs/format/log_source.h"

namespace scoria::app {

/// What of a log is written, and where to.
struct ExportOptions {
  std::filesystem::path log, out;
  std::optional<std::vector<std::string>> topics;  // none: all
  std::optional<double> from_s, to_s;              // since the log's first message; none: no limit
  std::vector<std::filesystem::path> msg_paths;    // as TypeResolver takes them
  std::optional<std::string> mapping;              // of signals: as RowsOptions has it
  bool force = false;                              // overwrite files that are there
  const std::atomic<bool>* interrupted = nullptr;  // ends the export, with nothing written
};

struct ExportedFile {
  std::filesystem::path path;
  std::uint64_t entries = 0;  // rows or messages
};

struct ExportResult {
  std::vector<ExportedFile> files;
  std::vector<std::string> remarks;  // what is not in them, and why
  bool was_interrupted = false;      // then there are no files
};

/// The log of an export, open, with the part of it that is wanted.
struct ExportSource {
  std::unique_ptr<logs::LogSource> log;
  logs::LogFilter filter;  // in the order in which the log is stored

  /// What is wrong with the log, found so far, a line each.
  [[nodiscard]] std::vector<std::string> Problems() const;
};

/// Errors: as OpenLog; std::runtime_error for a topic that the log does not have.
[[nodiscard]] ExportSource OpenExport(const ExportOptions& options);

/// Errors: std::runtime_error if the file is there and may not be overwritten, or is a folder.
void CheckTarget(const std::filesystem::path& file, const ExportOptions& options);

[[nodiscard]] inline bool IsInterrupted(const ExportOptions& options) {
  return options.interrupted != nullptr && options.interrupted->load();
}

}  // namespace scoria::app
