// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/cluster_bootstrap.h"

#include <cmath>
#include <limits>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

#include "analysis/statistics/mean.h"
#include "core/rng.h"

namespace scoria::analysis {
namespace {

double LogRatio(const PairedCounts& c) {
  return std::log((static_cast<double>(c.events_a) + 0.5) / c.exposure_a) -
         std::log((static_cast<double>(c.events_b) + 0.5) / c.exposure_b);
}

}  // namespace

RatioEstimate BootstrapRateRatio(std::span<const PairedCounts> terrains, std::uint64_t seed,
                                 int resamples, double confidence) {
  PairedCounts sum;
  for (const PairedCounts& t : terrains) sum += t;
  if (terrains.size() < 3 || sum.events_a + sum.events_b == 0) {
    return {std::numeric_limits<double>::quiet_NaN(),
            {0.0, std::numeric_limits<double>::infinity()},
            1.0};
  }
  core::Rng rng(seed, 0, core::Stream::kBootstrap);
  std::vector<double> log_ratios;
  for (int i = 0; i < resamples; ++i) {
    PairedCounts resampled;
    for (std::size_t k = 0; k < terrains.size(); ++k) {
      const double pick = rng.NextUniform() * static_cast<double>(terrains.size());
      resampled += terrains[static_cast<std::size_t>(pick)];
    }
    log_ratios.push_back(LogRatio(resampled));
  }
  const double n = static_cast<double>(terrains.size()), log_ratio = LogRatio(sum);
  const double error = EstimateMean(log_ratios).deviation * std::sqrt(n / (n - 1.0));
  constexpr double kNoSpread = 1e-9;  // rounding, where all terrains are alike
  if (error < kNoSpread)
    return {std::exp(log_ratio), {0.0, std::numeric_limits<double>::infinity()}, 1.0};
  const boost::math::students_t_distribution<double> t(n - 1.0);
  const double half = quantile(t, 0.5 + 0.5 * confidence) * error;
  return {std::exp(log_ratio),
          {std::exp(log_ratio - half), std::exp(log_ratio + half)},
          2.0 * cdf(complement(t, std::abs(log_ratio) / error))};
}

}  // namespace scoria::analysis
