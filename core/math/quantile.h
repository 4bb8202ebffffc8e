// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/demand.h"

namespace scoria::core {

/// Quantile of a sample by linear interpolation between its ordered values.
/// @param values not empty, finite. @param share in [0, 1]. Source: [HyndmanFan1996], definition 7.
[[nodiscard]] inline double SampleQuantile(std::vector<double> values, double share) {
  SCORIA_DEMAND(!values.empty() && share >= 0.0 && share <= 1.0, "{} values, share {}",
                values.size(), share);
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto i = static_cast<std::size_t>(at);
  const std::size_t next = std::min(i + 1, values.size() - 1);
  return values[i] + (at - static_cast<double>(i)) * (values[next] - values[i]);
}

}  // namespace scoria::core
