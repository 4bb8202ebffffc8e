// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "analysis/report/document.h"
#include "analysis/signals/motion.h"
#include "core/robot/legs.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Height, speed, attitude, stance and fallbacks over time, from rows as they come. Memory is
/// bounded: of a long log fewer rows are kept.
class CourseFigure {
 public:
  /// @param most_rows  that are kept, at least half as many of a longer log.
  explicit CourseFigure(std::size_t most_rows) : most_rows_(most_rows) {}

  void Add(const logs::Row& row);
  [[nodiscard]] bool IsEmpty() const noexcept { return rows_.empty(); }

  /// @param name     what it is the course of.
  /// @param marks_s  of falls.
  /// @param gaps_s   over which no line is drawn.
  [[nodiscard]] CaptionedFigure Draw(const std::string& name, const std::vector<double>& marks_s,
                                     const std::vector<std::pair<double, double>>& gaps_s,
                                     const std::string& caption) const;

 private:
  std::size_t most_rows_, every_ = 1, seen_ = 0;
  std::vector<logs::Row> rows_;
};

}  // namespace scoria::analysis
