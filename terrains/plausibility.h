// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrains/height_table.h"
#include "terrains/resample.h"

namespace scoria::terrains {

/// Every cell of the window is a height that a planet has: no gap, declared or not, and no spike or
/// pit of one or two cells.
/// Errors: core::ConfigError that names file, line, row and value.
void CheckHeights(const HeightmapParams& params, const HeightTable& table,
                  const TileWindow& window);

}  // namespace scoria::terrains
