// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/statistics/interval.h"
#include "analysis/statistics/sampling.h"

namespace scoria::analysis {

/// What share of the variance of a response a factor explains: alone, and with all its
/// interactions.
struct SobolIndices {
  double first = 0.0, total = 0.0;
  Interval total_interval;  // 95 %, by resampling rows
};

/// The points that the indices are estimated from, row by row of the sample: its first half a, its
/// second half b, then a with one coordinate after the other taken from b.
/// @param sample  points of 2 k dimensions. @returns k + 2 points of k dimensions for each.
/// Source: [Saltelli2010].
[[nodiscard]] std::vector<UnitPoint> SensitivityPoints(std::span<const UnitPoint> sample);

/// Points of SensitivityPoints for one row, and how many rows a number of points allows.
[[nodiscard]] constexpr std::size_t PointsPerRow(std::size_t factors) { return factors + 2; }

/// @param responses  at the points of SensitivityPoints, whole rows. @param factors  k > 0.
/// @returns an index for each factor; NaN where the response does not vary, the interval NaN for
/// fewer than five rows. A response with random errors that are not shared by the points has them
/// in every total index.
/// Source: [Jansen1999], as [Saltelli2010] tables 2.
[[nodiscard]] std::vector<SobolIndices> EstimateSobolIndices(std::span<const double> responses,
                                                             std::size_t factors,
                                                             std::uint64_t seed);

}  // namespace scoria::analysis
