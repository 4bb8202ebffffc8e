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

double LogRatio(const CountsInTwoSettings& c) { return LogRatio(c.first) - LogRatio(c.second); }

RatioEstimate NothingKnown() {
  return {std::numeric_limits<double>::quiet_NaN(),
          {0.0, std::numeric_limits<double>::infinity()},
          1.0};
}

template <class Counts>
Counts Sum(std::span<const Counts> terrains) {
  Counts sum;
  for (const Counts& t : terrains) sum += t;
  return sum;
}

/// Of the log ratio of resampled terrains, as standard deviation.
template <class Counts>
double ResampledError(std::span<const Counts> terrains, std::uint64_t seed, int resamples) {
  core::Rng rng(seed, 0, core::Stream::kBootstrap);
  const double n = static_cast<double>(terrains.size());
  std::vector<double> log_ratios;
  for (int i = 0; i < resamples; ++i) {
    Counts resampled;
    for (std::size_t k = 0; k < terrains.size(); ++k)
      resampled += terrains[static_cast<std::size_t>(rng.NextUniform() * n)];
    log_ratios.push_back(LogRatio(resampled));
  }
  return EstimateMean(log_ratios).deviation * std::sqrt(n / (n - 1.0));
}

template <class Counts>
RatioEstimate Bootstrap(std::span<const Counts> terrains, std::uint64_t seed, int resamples,
                        double confidence) {
  const double log_ratio = LogRatio(Sum(terrains));
  const double error = ResampledError(terrains, seed, resamples);
  constexpr double kNoSpread = 1e-9;  // rounding, where all terrains are alike
  if (error < kNoSpread)
    return {std::exp(log_ratio), {0.0, std::numeric_limits<double>::infinity()}, 1.0};
  const boost::math::students_t_distribution<double> t(static_cast<double>(terrains.size()) - 1.0);
  const double half = quantile(t, 0.5 + 0.5 * confidence) * error;
  return {std::exp(log_ratio),
          {std::exp(log_ratio - half), std::exp(log_ratio + half)},
          2.0 * cdf(complement(t, std::abs(log_ratio) / error))};
}

constexpr std::size_t kFewestTerrains = 3;

bool AnyEvent(const PairedCounts& c) { return c.events_a + c.events_b > 0; }

}  // namespace

RatioEstimate BootstrapRateRatio(std::span<const PairedCounts> terrains, std::uint64_t seed,
                                 int resamples, double confidence) {
  if (terrains.size() < kFewestTerrains || !AnyEvent(Sum(terrains))) return NothingKnown();
  return Bootstrap(terrains, seed, resamples, confidence);
}

RatioEstimate BootstrapRatioOfRatios(std::span<const CountsInTwoSettings> terrains,
                                     std::uint64_t seed, int resamples, double confidence) {
  const CountsInTwoSettings sum = Sum(terrains);
  if (terrains.size() < kFewestTerrains || !AnyEvent(sum.first) || !AnyEvent(sum.second))
    return NothingKnown();
  return Bootstrap(terrains, seed, resamples, confidence);
}

}  // namespace scoria::analysis
