// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/types.h"
#include "terrains/params.h"

namespace scoria::terrains {

/// Measured heights as a file holds them: the first row in the north, a cell of dx by dy each.
struct HeightTable {
  enum class Cell : std::uint8_t { kHeight, kNoData, kNotFinite };

  int columns = 0, rows = 0;
  double dx_m = 0.0, dy_m = 0.0;
  Vec2 corner_m = Vec2::Zero();   // south-west corner of the south-west cell, as the file counts
  std::vector<double> heights_m;  // row * columns + column
  std::vector<Cell> cells;        // empty: all are heights
  std::vector<int> lines;         // of text, in which each row starts; empty: not text

  [[nodiscard]] std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
  [[nodiscard]] double at(int column, int row) const { return heights_m[Index(column, row)]; }
};

/// Errors: core::ConfigError that names the file, a line of it if any, and the rule.
[[noreturn]] void FailHeightmap(const HeightmapParams& params, int line, const std::string& rule);

/// Errors: core::ConfigError if a file of that many cells cannot be held.
void CheckTableSize(const HeightmapParams& params, double columns, double rows);

/// A 16-bit grey PNG, its cells `spacing_m` wide. Errors: core::ConfigError.
[[nodiscard]] HeightTable ReadPng(const HeightmapParams& params, double spacing_m);

/// An ESRI ASCII grid as it is met with: header keys in any case and order, corner or centre, one
/// cellsize or dx and dy; line ends and blank lines anywhere, a byte order mark, comments after #,
/// ; or //; decimal commas; exponents with E or D.
/// Source: ESRI ASCII raster format; GDAL's AAIGrid driver for dx, dy.
/// Errors: core::ConfigError.
[[nodiscard]] HeightTable ReadEsriGrid(const HeightmapParams& params);

}  // namespace scoria::terrains
