// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/mean.h"

#include <cmath>
#include <limits>

#include <boost/math/distributions/students_t.hpp>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {

MeanEstimate EstimateMean(std::span<const double> values, double confidence) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  MeanEstimate e{values.size(), kNan, {-kInfinity, kInfinity}, 0.0};
  if (values.empty()) return e;
  const auto n = static_cast<double>(values.size());
  e.mean = 0.0;
  for (const double v : values) e.mean += v / n;
  if (values.size() < 2) return e;
  double squares = 0.0;
  for (const double v : values) squares += (v - e.mean) * (v - e.mean);
  const boost::math::students_t_distribution<double> t(n - 1.0);
  e.deviation = std::sqrt(squares / (n - 1.0));
  const double half = quantile(t, 0.5 + 0.5 * confidence) * e.deviation / std::sqrt(n);
  e.interval = {e.mean - half, e.mean + half};
  return e;
}

}  // namespace scoria::analysis
