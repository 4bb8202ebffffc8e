// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "terrains/heightfield.h"
#include "terrains/params.h"

namespace scoria::terrains {

/// The ground of one episode: base plane + self-affine roughness + rocks. The same arguments give
/// the same bits.
[[nodiscard]] Heightfield GenerateTerrain(const TerrainParams& params, std::uint64_t seed,
                                          std::uint32_t episode);

/// Number of rocks per square metre with diameter above D, for D in [min_diameter_m,
/// max_diameter_m]. Source: [Golombek1997], differentiated and divided by the area of one rock.
[[nodiscard]] double RockDensity(const RockParams& rocks, double above_diameter_m);

/// What a heightfield achieved, measured on its grid.
struct TerrainStatistics {
  double nu_10cm_m = 0.0, nu_25cm_m = 0.0,
         nu_1m_m = 0.0;  // RMS height difference at these lags, base plane removed
  double hurst = 0.0;    // slope of log nu(L) for lags from 5 nodes to a tenth of max_wavelength_m
  double slope_mean_rad = 0.0, slope_95_rad = 0.0;  // at the node spacing
};
[[nodiscard]] TerrainStatistics MeasureTerrain(const Heightfield& ground,
                                               const TerrainParams& params);

}  // namespace scoria::terrains
