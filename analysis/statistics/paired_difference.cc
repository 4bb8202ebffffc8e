// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/paired_difference.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>

#include "core/demand.h"
#include "core/math/quantile.h"
#include "core/rng.h"

namespace scoria::analysis {
namespace {

/// Expanded percentile interval of the mean.
Interval BootstrapMean(std::span<const double> values, std::uint64_t seed, double confidence) {
  constexpr int kResamples = 1000;
  core::Rng rng(seed, 2, core::Stream::kBootstrap);
  const double n = static_cast<double>(values.size());
  std::vector<double> means;
  for (int i = 0; i < kResamples; ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k)
      sum += values[static_cast<std::size_t>(rng.NextUniform() * n)];
    means.push_back(sum / n);
  }
  const boost::math::students_t_distribution<double> student(n - 1.0);
  const double z = std::sqrt(n / (n - 1.0)) * quantile(student, 0.5 + 0.5 * confidence);
  const double share = cdf(boost::math::normal_distribution<double>(), -z);
  return {core::SampleQuantile(means, share), core::SampleQuantile(means, 1.0 - share)};
}

std::optional<double> Correlate(std::span<const double> a, std::span<const double> b) {
  const MeanEstimate of_a = EstimateMean(a), of_b = EstimateMean(b);
  if (a.size() < 2 || of_a.deviation <= 0.0 || of_b.deviation <= 0.0) return std::nullopt;
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
  const double r = sum / (static_cast<double>(a.size()) - 1.0) / (of_a.deviation * of_b.deviation);
  return std::clamp(r, -1.0, 1.0);
}

/// Student's, two-sided. Differences that are all equal are no chance, unless they are zero.
double TestZero(const MeanEstimate& e) {
  if (e.count < 2) return 1.0;
  if (e.deviation == 0.0) return e.mean == 0.0 ? 1.0 : 0.0;
  const double n = static_cast<double>(e.count);
  const boost::math::students_t_distribution<double> student(n - 1.0);
  return 2.0 * cdf(complement(student, std::abs(e.mean) / e.deviation * std::sqrt(n)));
}

}  // namespace

PairedDifference EstimateDifference(std::span<const double> a, std::span<const double> b,
                                    std::uint64_t seed, double confidence) {
  SCORIA_DEMAND(a.size() == b.size(), "{} and {} values", a.size(), b.size());
  constexpr std::size_t kEnoughPairs = 5;
  std::vector<double> differences;
  for (std::size_t i = 0; i < a.size(); ++i) differences.push_back(a[i] - b[i]);
  PairedDifference d;
  d.mean_a = EstimateMean(a).mean;
  d.mean_b = EstimateMean(b).mean;
  d.difference = EstimateMean(differences, confidence);
  if (differences.size() >= kEnoughPairs)
    d.bootstrap = BootstrapMean(differences, seed, confidence);
  if (d.difference.deviation > 0.0) d.effect_size = d.difference.mean / d.difference.deviation;
  d.correlation = Correlate(a, b);
  d.p_value = TestZero(d.difference);
  return d;
}

}  // namespace scoria::analysis
