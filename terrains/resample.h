// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "terrains/grid.h"
#include "terrains/height_table.h"

namespace scoria::terrains {

/// Cells of a HeightTable, rows from the north.
struct TileWindow {
  int first_column = 0, first_row = 0, columns = 0, rows = 0;
};

/// The window's heights at `nodes` x `nodes` places `spacing_m` apart, about its middle: bicubic
/// (Catmull-Rom, as Heightfield is between its nodes), with a kernel as wide as the new cells where
/// they are coarser than the old. Beyond the window its border continues.
[[nodiscard]] Grid Resample(const HeightTable& table, const TileWindow& window, int nodes,
                            double spacing_m);

}  // namespace scoria::terrains
