// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/log_rank.h"

#include <algorithm>
#include <set>

#include <boost/math/distributions/chi_squared.hpp>

namespace scoria::analysis {
namespace {

double AtRisk(const std::vector<Lifetime>& arm, double length) {
  return static_cast<double>(
      std::count_if(arm.begin(), arm.end(), [&](const Lifetime& l) { return l.length >= length; }));
}

double EventsAt(const std::vector<Lifetime>& arm, double length) {
  return static_cast<double>(std::count_if(
      arm.begin(), arm.end(), [&](const Lifetime& l) { return l.event && l.length == length; }));
}

}  // namespace

LogRank TestLogRank(std::span<const SurvivalStratum> strata) {
  LogRank r;
  double variance = 0.0;
  for (const SurvivalStratum& stratum : strata) {
    std::set<double> lengths;
    for (const std::vector<Lifetime>* arm : {&stratum.a, &stratum.b}) {
      for (const Lifetime& l : *arm) {
        if (l.event) lengths.insert(l.length);
      }
    }
    for (const double length : lengths) {
      const double n_a = AtRisk(stratum.a, length), n = n_a + AtRisk(stratum.b, length);
      const double d_a = EventsAt(stratum.a, length), d = d_a + EventsAt(stratum.b, length);
      r.observed_a += d_a;
      r.observed_b += d - d_a;
      r.expected_a += d * n_a / n;
      r.expected_b += d * (n - n_a) / n;
      if (n > 1.0) variance += d * n_a / n * (1.0 - n_a / n) * (n - d) / (n - 1.0);
    }
  }
  if (variance <= 0.0) return r;
  const double excess = r.observed_a - r.expected_a;
  r.chi2 = excess * excess / variance;
  r.p_value = cdf(complement(boost::math::chi_squared_distribution<double>(1.0), r.chi2));
  return r;
}

}  // namespace scoria::analysis
