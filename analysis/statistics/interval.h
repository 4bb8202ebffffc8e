// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace scoria::analysis {

struct Interval {
  double low = 0.0, high = 0.0;
  [[nodiscard]] bool Contains(double x) const noexcept { return low <= x && x <= high; }
};

}  // namespace scoria::analysis
