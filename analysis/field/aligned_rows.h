// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <functional>
#include <optional>

#include "analysis/field/truth_alignment.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Passes rows on with the truth that an alignment makes of theirs: that of the row's time, of the
/// trunk's origin, in its axes. Rows wait for a truth that is late. Where truth is missing for more
/// than kLongestPause_s the row has none.
class AlignedRows {
 public:
  static constexpr double kLongestPause_s = MotionSamples::kLongestPause_s;
  using OnRow = std::function<void(const logs::Row&)>;

  AlignedRows(const TruthAlignment& alignment, OnRow on_row);
  void Add(const logs::Row& row);
  /// Passes on the rows that still wait.
  void Finish();

 private:
  struct TimedTruth {
    double time_s = 0.0;
    logs::TruthRow truth;
  };
  [[nodiscard]] bool IsReady(const logs::Row& row) const;
  [[nodiscard]] std::optional<logs::TruthRow> TruthAt(double time_s) const;
  [[nodiscard]] logs::TruthRow OfTrunk(const logs::TruthRow& markers) const;
  void PassFirst();

  TruthAlignment alignment_;
  OnRow on_row_;
  std::deque<logs::Row> waiting_;
  std::deque<TimedTruth> truths_;
  std::optional<double> newest_s_;
};

}  // namespace scoria::analysis
