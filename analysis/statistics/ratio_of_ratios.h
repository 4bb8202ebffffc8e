// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "analysis/statistics/cluster_bootstrap.h"

namespace scoria::analysis {

/// Does a rate ratio a : b depend on the setting? Its ratio, first to second setting.
struct RatioOfRatios {
  /// Given all four counts' margins: falls Poisson given the terrain.
  RatioEstimate exact;
  RatioEstimate by_terrain;
  /// To judge by: the wider interval and the larger p-value of both, from six terrains on; of the
  /// exact alone with fewer.
  RatioEstimate judged;
};

/// Given how many events an arm and a setting have, those of a in the first are Fisher's
/// non-central hypergeometric, whose odds are the ratio of ratios times that of the exposures. A
/// setting without events says nothing: NaN with the interval [0, inf).
/// @param terrains  walked by both arms in both settings.
/// Source: [Cornfield1956].
[[nodiscard]] RatioOfRatios CompareRatios(std::span<const CountsInTwoSettings> terrains,
                                          double confidence = 0.95);

}  // namespace scoria::analysis
