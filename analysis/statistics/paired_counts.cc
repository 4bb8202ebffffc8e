// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/paired_counts.h"

#include <boost/math/distributions/chi_squared.hpp>

namespace scoria::analysis {

Dispersion CheckShares(std::span<const PairedCounts> terrains) {
  Dispersion d;
  PairedCounts sum;
  for (const PairedCounts& t : terrains) sum += t;
  if (sum.events_a == 0 || sum.events_b == 0) return d;
  const double ratio = static_cast<double>(sum.events_a) / sum.exposure_a /
                       (static_cast<double>(sum.events_b) / sum.exposure_b);
  double chi2 = 0.0;
  int used = 0;
  for (const PairedCounts& t : terrains) {
    const double total = static_cast<double>(t.events_a + t.events_b);
    if (total == 0.0) continue;
    const double share = ratio * t.exposure_a / (ratio * t.exposure_a + t.exposure_b);
    const double difference = static_cast<double>(t.events_a) - total * share;
    chi2 += difference * difference / (total * share * (1.0 - share));
    ++used;
  }
  if (used < 2) return d;
  // Given the totals, its mean is n / (n - 1) times the degrees of freedom.
  const double n = static_cast<double>(sum.events_a + sum.events_b);
  chi2 *= (n - 1.0) / n;
  d.index = chi2 / (used - 1.0);
  d.p_value = cdf(complement(boost::math::chi_squared_distribution<double>(used - 1.0), chi2));
  return d;
}

}  // namespace scoria::analysis
