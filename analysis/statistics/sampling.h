// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scoria::analysis {

/// A point of the unit cube: a coordinate in [0, 1) for each dimension.
using UnitPoint = std::vector<double>;

/// The first points of Sobol's sequence, each coordinate shifted digit by digit by a random number:
/// every point is uniform, and together they are as even as the sequence. Powers of two are best.
/// @param dimensions  1 to 3667. Source: [Sobol1967], directions [JoeKuo2008] (Boost.Random);
/// shift [Matousek1998].
[[nodiscard]] std::vector<UnitPoint> SampleSobol(std::size_t points, std::size_t dimensions,
                                                 std::uint64_t seed);

/// Latin hypercube: in each dimension one point in each of `points` equal intervals, at random
/// within it. Source: [McKay1979].
[[nodiscard]] std::vector<UnitPoint> SampleLatinHypercube(std::size_t points,
                                                          std::size_t dimensions,
                                                          std::uint64_t seed);

}  // namespace scoria::analysis
