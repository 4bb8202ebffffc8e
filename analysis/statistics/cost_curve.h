// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scoria::analysis {

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
