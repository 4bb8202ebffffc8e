// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "terrains/generator.h"

namespace scoria::analysis {

/// As logs and results hold them.
[[nodiscard]] nlohmann::json ToJson(const terrains::TerrainStatistics& statistics);
/// Errors: nlohmann::json::exception on a missing key.
[[nodiscard]] terrains::TerrainStatistics StatisticsFromJson(const nlohmann::json& json);

/// Name, statistics and deviogram of a ground.
[[nodiscard]] nlohmann::json TerrainJson(const terrains::Heightfield& ground,
                                         const terrains::TerrainParams& params,
                                         const terrains::TerrainStatistics& statistics);

/// A ground as people look at it: relief.png (shaded relief under a material overlay, the whole
/// tile and a close-up), deviogram.{svg,png,pdf,gp} against its target, terrain.json with the
/// numbers. Errors: std::runtime_error (files, gnuplot).
void WriteTerrainView(const terrains::Heightfield& ground, const terrains::TerrainParams& params,
                      const terrains::TerrainStatistics& statistics,
                      const std::filesystem::path& folder);

}  // namespace scoria::analysis
