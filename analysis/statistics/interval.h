// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace scoria::analysis {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval {
  double low = 0.0, high = 0.0;
  [[nodiscard]] bool Contains(double x) const noexcept { return low <= x && x <= high; }
};

}  // namespace scoria::analysis
