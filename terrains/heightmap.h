// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrains/grid.h"
#include "terrains/params.h"

namespace scoria::terrains {

/// Reads a measured ground: a square 16-bit grey PNG (north up; spacing as given), or a square ESRI
/// ASCII grid (its own cell size). Heights in metres.
/// Errors: core::ConfigError that names the file, the line of an ASCII grid, and the rule.
[[nodiscard]] Grid ReadHeightmap(const HeightmapParams& params, double png_spacing_m);

}  // namespace scoria::terrains
