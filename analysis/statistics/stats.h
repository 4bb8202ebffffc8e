// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/statistics/interval.h"

namespace scoria::analysis {

/// Quantile of a sample by linear interpolation between its ordered values.
/// @param values not empty. @param share in [0, 1].
[[nodiscard]] double SampleQuantile(std::vector<double> values, double share);

/// Mean with Student's interval, (-inf, inf) for fewer than two values, and their standard
/// deviation, 0 for fewer than two.
struct MeanEstimate {
  std::size_t count = 0;
  double mean = 0.0;
  Interval interval;
  double deviation = 0.0;
};
[[nodiscard]] MeanEstimate EstimateMean(std::span<const double> values, double confidence = 0.95);

/// A Poisson rate from `events` in `exposure`, with the exact (Garwood) interval.
struct RateEstimate {
  long events = 0;
  double exposure = 0.0;
  double rate = 0.0;  // events per unit of exposure
  Interval interval;  // of the rate
};
/// @param exposure > 0. @param confidence in (0, 1). Source: [Garwood1936].
[[nodiscard]] RateEstimate EstimateRate(long events, double exposure, double confidence = 0.95);

/// Ratio of the rate of `a` to the rate of `b`, exact given the total: events of a are binomial
/// with probability r x_a / (r x_a + x_b). The interval is Clopper-Pearson's; p tests "the rates
/// are equal", two-sided. Without any event the ratio is undefined: NaN with the interval [0, inf).
struct RatioEstimate {
  double ratio = 0.0;
  Interval interval;
  double p_value = 1.0;
};
/// Source: [Przyborowski1940].
[[nodiscard]] RatioEstimate EstimateRateRatio(const RateEstimate& a, const RateEstimate& b,
                                              double confidence = 0.95);

/// The smallest rate ratio above 1 that this budget detects with probability `power` at two-sided
/// level 1 - confidence, if the lower rate is `rate` (normal approximation on log rates, [Lehr1992]
/// form). Infinite without events.
[[nodiscard]] double DetectableRatio(double rate, double exposure_each, double power = 0.8);

/// Counts of two arms on the same terrain.
struct PairedCounts {
  long events_a = 0, events_b = 0;
  double exposure_a = 0.0, exposure_b = 0.0;
};

/// Does one arm's share of the falls differ between terrains more than chance allows? Terrains that
/// are harder for both arms do not matter: the comparison is paired.
struct Dispersion {
  double index = 1.0;    // chi-squared over degrees of freedom; 1 when only chance is at work
  double p_value = 1.0;  // of "only chance", one-sided
};
[[nodiscard]] Dispersion CheckShares(std::span<const PairedCounts> terrains);

/// Interval of the rate ratio by resampling terrains (clusters) with their pairs of counts. Needs
/// >= 3 terrains.
[[nodiscard]] Interval BootstrapRateRatio(std::span<const PairedCounts> terrains,
                                          std::uint64_t seed, int resamples = 2000,
                                          double confidence = 0.95);

/// Robust fit of y = b + c x + a / x (cost of transport against speed), with r² and a pointwise
/// bootstrap band.
struct CurveFit {
  bool valid = false;
  double a = 0.0, b = 0.0, c = 0.0;
  double r2 = 0.0;                // of all points, whatever weight the fit gave them
  std::vector<double> x, y;       // curve on a grid over the data's range
  std::vector<double> low, high;  // its 95 % band; empty with too few clusters
};
/// A point of the curve. Points of one cluster (an episode) are not independent of each other.
struct CurvePoint {
  double x = 0.0, y = 0.0;
  std::size_t cluster = 0;
};
/// Iteratively reweighted least squares with Huber's weights ([Huber1964]) on the scale of the
/// median absolute residual; the band resamples whole clusters among those of the same mean x
/// (steps of 0.1). Five clusters, three for each mean x on average, are the least for a band.
/// @param terms how many of b, c x, a / x the data can carry: at most the number of distinct
/// commanded speeds, 1 to 3.
[[nodiscard]] CurveFit FitCostCurve(std::span<const CurvePoint> points, int terms,
                                    std::uint64_t seed);

/// "b + c v", as fitted.
[[nodiscard]] std::string_view CostCurveFormula(int terms) noexcept;

}  // namespace scoria::analysis
