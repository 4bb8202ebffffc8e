// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "terrains/heightfield.h"
#include "terrains/params.h"
#include "terrains/rocks.h"

namespace scoria::terrains {

/// A ground and how it was made.
struct Terrain {
  Heightfield ground;
  std::size_t cut_nodes = 0;          // lowered to max_slope_rad
  std::optional<std::string> remark;  // on a heightmap's tile
};

/// What of a measured ground is not as its file has it; one sentence each. Generated relief is cut
/// by design.
[[nodiscard]] std::vector<std::string> HeightmapRemarks(const Terrain& terrain,
                                                        const TerrainParams& params);

/// The ground of one episode: base plane, large forms, self-affine roughness, ripples, rocks, and
/// the materials that lie on it. The same arguments give the same bits.
/// Errors: core::ConfigError of a heightmap that cannot be used.
[[nodiscard]] Terrain MakeTerrain(const TerrainParams& params, std::uint64_t seed,
                                  std::uint32_t episode);

/// The ground alone of MakeTerrain.
[[nodiscard]] Heightfield GenerateTerrain(const TerrainParams& params, std::uint64_t seed,
                                          std::uint32_t episode);

/// What a heightfield achieved, measured on its grid with its mean plane removed. NaN where the
/// grid is too coarse, too small or too level to tell.
struct TerrainStatistics {
  double nu_10cm_m = 0.0, nu_25cm_m = 0.0, nu_1m_m = 0.0;  // RMS height difference at these lags
  double hurst =
      0.0;  // slope of log nu over log lag, from the break to a tenth of the longest wave
  double slope_mean_rad = 0.0, slope_95_rad = 0.0;  // at the node spacing
  struct Share {
    std::string material;
    double fraction = 0.0;  // of the area
  };
  std::vector<Share> materials;  // the substrate first; rocks are one of them
};
[[nodiscard]] TerrainStatistics MeasureTerrain(const Heightfield& ground,
                                               const TerrainParams& params);

/// One point of a deviogram.
struct Deviation {
  double lag_m = 0.0, measured_m = 0.0;
  double target_m = 0.0;  // of the roughness spectrum; 0 without one
};
[[nodiscard]] std::vector<Deviation> MeasureDeviogram(const Heightfield& ground,
                                                      const TerrainParams& params);

/// Names a ground: equal for equal parameters, seed and content of the heightmap, in hexadecimal.
[[nodiscard]] std::string GroundId(const TerrainParams& params, std::uint64_t seed);

}  // namespace scoria::terrains
