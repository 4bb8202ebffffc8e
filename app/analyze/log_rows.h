// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "logs/mapping/any_rows.h"

namespace scoria::app {

/// The rows of a log of whatever origin, as often as they are wanted.
class LogRows {
 public:
  /// @param files    one path, or several CSV files on one clock.
  /// @param options  a mapping that is asked for is used even where the log has rows of its own.
  /// Errors: as logs::MappingFor; core::FileError; std::runtime_error for what is no log.
  LogRows(std::vector<std::filesystem::path> files, logs::RowsOptions options);

  /// Null for a log that has rows of its own.
  [[nodiscard]] const logs::Mapping* mapping() const noexcept {
    return mapping_ ? &*mapping_ : nullptr;
  }
  /// Read by another mapping from now on.
  void SetMapping(logs::Mapping mapping) { mapping_.emplace(std::move(mapping)); }

  [[nodiscard]] const std::vector<std::filesystem::path>& files() const noexcept { return files_; }
  [[nodiscard]] const std::vector<std::filesystem::path>& msg_paths() const noexcept {
    return options_.msg_paths;
  }

  /// Calls on_row with every row. Errors: as logs::ForEachRow.
  logs::RowsReport ForEach(const std::function<void(const logs::Row&)>& on_row) const;

 private:
  std::vector<std::filesystem::path> files_;
  logs::RowsOptions options_;
  std::optional<logs::Mapping> mapping_;
};

}  // namespace scoria::app
