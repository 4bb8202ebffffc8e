// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "terrains/grid.h"
#include "terrains/params.h"

namespace scoria::terrains {

/// A square tile of measured ground.
struct Heightmap {
  Grid heights;                       // m
  std::optional<std::string> remark;  // how the tile was made, unless it is the file cell by cell
};

/// Reads a measured ground: a 16-bit grey PNG (north up) or an ESRI ASCII grid, whatever its name
/// ends in. `resolution_m` is the cell of a PNG, and that of the tile if the grid's own cells are
/// not square, or not 0.005 to 0.5 m wide: then each node is the Catmull-Rom interpolant at its
/// place, stretched to a mean over its cell where the file's cells are finer.
/// Errors: core::ConfigError that names the file, the line of an ASCII grid, and the rule; every
/// height of the tile must be one that a planet has.
[[nodiscard]] Heightmap ReadHeightmap(const HeightmapParams& params, double resolution_m);

}  // namespace scoria::terrains
