// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "analysis/signals/falls.h"
#include "analysis/signals/motion.h"
#include "logs/row.h"

namespace scoria::analysis {

/// What a row tells of a fall, by one source of the trunk's motion. The force on the trunk and the
/// ground's height are only known with the truth. None where the row lacks that source.
[[nodiscard]] std::optional<FallSample> FindFallSample(const logs::Row& row, MotionSource source,
                                                       double dt_s);

/// Finds the falls of a log from its rows. Placements are those that the rows name; a log whose
/// rows do not say so has the robot upright again as FallDetector finds it.
class RowFalls {
 public:
  RowFalls(const FallParams& params, double nominal_trunk_height_m, MotionSource source) noexcept
      : detector_(params, nominal_trunk_height_m), source_(source) {}

  void Add(const logs::Row& row);
  [[nodiscard]] const std::vector<FallEvent>& falls() const noexcept { return falls_; }
  [[nodiscard]] MotionSource source() const noexcept { return source_; }

 private:
  FallDetector detector_;
  MotionSource source_;
  std::vector<FallEvent> falls_;
  std::optional<double> last_s_;
  std::optional<std::uint32_t> segment_;
};

}  // namespace scoria::analysis
