// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/two_samples.h"

#include <cmath>
#include <vector>

#include <boost/math/distributions/students_t.hpp>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {
namespace {

struct Sample {
  double count = 0.0, mean = 0.0, variance = 0.0;  // the variance of values, 0 for one
};

Sample Describe(std::span<const double> values) {
  Sample s{static_cast<double>(values.size())};
  for (const double v : values) s.mean += v / s.count;
  if (values.size() < 2) return s;
  for (const double v : values) s.variance += (v - s.mean) * (v - s.mean) / (s.count - 1.0);
  return s;
}

}  // namespace

TwoSamples CompareSamples(std::span<const double> a, std::span<const double> b, double confidence) {
  Sample first = Describe(a), second = Describe(b);
  TwoSamples out{a.size(), b.size(), first.mean, second.mean, {-kInfinity, kInfinity}, {}, {}};
  const double freedoms_a = first.count - 1.0, freedoms_b = second.count - 1.0;
  const double pooled =
      (freedoms_a * first.variance + freedoms_b * second.variance) / (freedoms_a + freedoms_b);
  if (freedoms_a + freedoms_b < 1.0 || !(pooled > 0.0)) return out;
  if (freedoms_a == 0.0) first.variance = second.variance;
  if (freedoms_b == 0.0) second.variance = first.variance;
  const double share_a = first.variance / first.count, share_b = second.variance / second.count;
  const double error = std::sqrt(share_a + share_b), difference = second.mean - first.mean;
  // Welch and Satterthwaite; a set of one value has no freedoms of its own.
  const double freedoms =
      freedoms_a == 0.0 || freedoms_b == 0.0
          ? freedoms_a + freedoms_b
          : (share_a + share_b) * (share_a + share_b) /
                (share_a * share_a / freedoms_a + share_b * share_b / freedoms_b);
  const boost::math::students_t_distribution<double> t(freedoms);
  const double margin = error * quantile(complement(t, 0.5 * (1.0 - confidence)));
  out.difference = {difference - margin, difference + margin};
  out.p = 2.0 * cdf(complement(t, std::abs(difference) / error));
  const double correction = 1.0 - 3.0 / (4.0 * (freedoms_a + freedoms_b) - 1.0);  // Hedges
  out.effect = correction * difference / std::sqrt(pooled);
  return out;
}

TwoSamples CompareMagnitudes(std::span<const double> a, std::span<const double> b,
                             double confidence) {
  const auto logarithms = [](std::span<const double> values) {
    std::vector<double> logs;
    for (const double v : values) logs.push_back(std::log(v));
    return logs;
  };
  TwoSamples out = CompareSamples(logarithms(a), logarithms(b), confidence);
  out.mean_a = std::exp(out.mean_a);
  out.mean_b = std::exp(out.mean_b);
  out.difference = {out.mean_a * std::expm1(out.difference.low),
                    out.mean_a * std::expm1(out.difference.high)};
  return out;
}

}  // namespace scoria::analysis
