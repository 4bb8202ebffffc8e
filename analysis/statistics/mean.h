// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {

/// Mean with Student's interval, (-inf, inf) for fewer than two values, and their standard
/// deviation, 0 for fewer than two.
struct MeanEstimate {
  std::size_t count = 0;
  double mean = 0.0;
  Interval interval;
  double deviation = 0.0;
};
[[nodiscard]] MeanEstimate EstimateMean(std::span<const double> values, double confidence = 0.95);

}  // namespace scoria::analysis
