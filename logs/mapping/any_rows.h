// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "logs/mapping/mapped_rows.h"

namespace scoria::logs {

/// By what rows are read.
struct RowsOptions {
  std::optional<std::string> mapping = std::nullopt;  // file, or name of a shipped one; none: see
                                                      // ForEachRow
  std::vector<std::filesystem::path> msg_paths = {};  // folders with message definitions
};

/// How rows were read.
struct RowsReport {
  std::optional<MappingReport> mapping;  // none: the log has rows of its own
  std::string problem;                   // what is wrong with the log, in words; empty if nothing
};

/// True for a log of scoria's with its canonical signals.
[[nodiscard]] bool HasOwnRows(const LogContents& contents);

/// The mapping that is asked for, or the shipped one that fits.
/// Errors: ConfigError, MappingChoiceError.
[[nodiscard]] Mapping MappingFor(const LogContents& contents,
                                 const std::optional<std::string>& asked_for);

/// Calls on_row with every row of a log of whatever origin: its own rows if scoria wrote it and no
/// mapping is asked for, else those of the mapping, or of the shipped one that fits.
/// @param log  one path, or several CSV files on one clock.
/// Errors: ConfigError, MappingChoiceError, DefinitionError, core::FileError, std::runtime_error
/// for what is no log; what on_row throws.
RowsReport ForEachRow(const std::vector<std::filesystem::path>& log, const RowsOptions& options,
                      const std::function<void(const Row&)>& on_row);

}  // namespace scoria::logs
