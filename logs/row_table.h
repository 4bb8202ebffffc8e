// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "logs/row.h"

namespace scoria::logs {

/// Rows as lines of text: a column per number, named by its group and field, as
/// "truth.p_WB_m[0]", after "time_s". Cells of what a row has not are empty; bools are 1 and 0, and
/// floats have the digits that read back to the same value.
class RowTable {
 public:
  /// @param groups  whose columns are there.
  explicit RowTable(const RowGroups& groups);

  [[nodiscard]] const std::vector<std::string>& columns() const noexcept { return columns_; }

  /// The cells of a row, until the next call.
  [[nodiscard]] std::span<const std::string> Read(const Row& row);

 private:
  RowGroups groups_;
  std::vector<std::string> columns_, cells_;
};

}  // namespace scoria::logs
