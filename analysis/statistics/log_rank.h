// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "analysis/statistics/survival.h"

namespace scoria::analysis {

/// Lifetimes of two arms under like conditions: on one terrain.
struct SurvivalStratum {
  std::vector<Lifetime> a, b;
};

/// Do two arms last equally long? Events are compared with those expected if they did, length by
/// length within each stratum, so that hard and easy terrains are not mixed.
struct LogRank {
  double observed_a = 0.0, expected_a = 0.0;
  double observed_b = 0.0, expected_b = 0.0;
  double chi2 = 0.0;     // one degree of freedom
  double p_value = 1.0;  // two-sided; 1 where nothing can be compared
};
/// Source: [Mantel1966]; stratified as [Kalbfleisch2002].
[[nodiscard]] LogRank TestLogRank(std::span<const SurvivalStratum> strata);

}  // namespace scoria::analysis
