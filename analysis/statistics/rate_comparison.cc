// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/rate_comparison.h"

#include <algorithm>

namespace scoria::analysis {

RateComparison CompareRates(const RateEstimate& a, const RateEstimate& b,
                            std::span<const PairedCounts> terrains, double confidence) {
  constexpr std::size_t kEnoughTerrains = 6;
  constexpr double kLevel = 0.2;
  constexpr std::uint64_t kBootstrapSeed = 20251017;
  constexpr int kResamples = 2000;
  RateComparison c;
  c.exact = EstimateRateRatio(a, b, confidence);
  c.by_terrain = BootstrapRateRatio(terrains, kBootstrapSeed, kResamples, confidence);
  c.dispersion = CheckShares(terrains);
  c.over_dispersed = terrains.size() >= kEnoughTerrains && c.dispersion.p_value < kLevel;
  c.judged = c.exact;
  if (!c.over_dispersed) return c;
  c.judged.interval = {std::min(c.exact.interval.low, c.by_terrain.interval.low),
                       std::max(c.exact.interval.high, c.by_terrain.interval.high)};
  c.judged.p_value = std::max(c.exact.p_value, c.by_terrain.p_value);
  return c;
}

}  // namespace scoria::analysis
