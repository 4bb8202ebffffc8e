// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/heightmap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include "core/file_kind.h"
#include "terrains/height_table.h"
#include "terrains/plausibility.h"
#include "terrains/resample.h"

namespace scoria::terrains {
namespace {

constexpr int kFewestNodes = 16, kMostNodes = 16384;
constexpr double kFinest_m = 0.005, kCoarsest_m = 0.5, kSmallestEdge_m = 6.0;

/// First cell and number of cells along one axis whose tile lies around `centre` best.
std::pair<int, int> Span(double corner, double cell_m, int cells, double edge_m, double centre) {
  const int count = std::min(cells, static_cast<int>(std::lround(edge_m / cell_m)));
  const double first = (centre - 0.5 * count * cell_m - corner) / cell_m;
  return {static_cast<int>(std::lround(std::clamp(first, -1e9, 1e9))), count};
}

/// A grid in degrees has cells of 1e-5 to 1e-2; taken for metres, it is far too small.
std::string DegreesHint(const HeightTable& table) {
  constexpr double kSuspect_m = 0.01;
  return std::min(table.dx_m, table.dy_m) < kSuspect_m && !table.lines.empty()
             ? " (is the grid in degrees? Project it to metres)"
             : "";
}

/// The cells that the tile is made of.
TileWindow ChooseTile(const HeightmapParams& params, const HeightTable& table) {
  const double width_m = table.columns * table.dx_m, height_m = table.rows * table.dy_m;
  const double widest_m = std::min(width_m, height_m);
  constexpr double kRounding = 1.0 + 1e-9;
  if (params.tile_m > widest_m * kRounding) {
    FailHeightmap(params, 0,
                  fmt::format("is {:g} x {:g} m; a tile_m of {:g} does not fit", width_m, height_m,
                              params.tile_m));
  }
  const double edge_m = params.tile_m > 0.0 ? params.tile_m : widest_m;
  if (edge_m < kSmallestEdge_m) {
    FailHeightmap(params, 0,
                  fmt::format("is {:g} m wide; a robot needs at least {} m{}", edge_m,
                              kSmallestEdge_m, DegreesHint(table)));
  }
  const Vec2 middle = table.corner_m + 0.5 * Vec2(width_m, height_m);
  const Vec2 centre = params.centre_m ? Vec2((*params.centre_m)[0], (*params.centre_m)[1]) : middle;
  TileWindow window;
  int first_from_south = 0;
  std::tie(window.first_column, window.columns) =
      Span(table.corner_m.x(), table.dx_m, table.columns, edge_m, centre.x());
  std::tie(first_from_south, window.rows) =
      Span(table.corner_m.y(), table.dy_m, table.rows, edge_m, centre.y());
  window.first_row = table.rows - first_from_south - window.rows;
  const bool inside = window.first_column >= 0 && window.first_row >= 0 &&
                      window.first_column + window.columns <= table.columns &&
                      window.first_row + window.rows <= table.rows;
  if (!inside) {
    FailHeightmap(
        params, 0,
        fmt::format("spans {} to {} east, {} to {} north; a tile of {:g} m about ({}, {}) "
                    "reaches beyond",
                    table.corner_m.x(), table.corner_m.x() + width_m, table.corner_m.y(),
                    table.corner_m.y() + height_m, edge_m, centre.x(), centre.y()));
  }
  return window;
}

void CheckNodes(const HeightmapParams& params, long nodes) {
  if (nodes < kFewestNodes) {
    FailHeightmap(params, 0,
                  fmt::format("has {} cells along an edge; at least {}", nodes, kFewestNodes));
  }
  if (nodes > kMostNodes) {
    FailHeightmap(params, 0,
                  fmt::format("has {} nodes along an edge; at most {}: choose a smaller "
                              "heightmap.tile_m or a coarser resolution_m",
                              nodes, kMostNodes));
  }
}

/// The window cell by cell, its rows turned to start in the south.
Grid Cut(const HeightTable& table, const TileWindow& window) {
  Grid heights(window.columns, table.dx_m);
  for (int row = 0; row < window.rows; ++row) {
    const int from_north = window.first_row + window.rows - 1 - row;
    for (int column = 0; column < window.columns; ++column)
      heights.at(column, row) = table.at(window.first_column + column, from_north);
  }
  return heights;
}

HeightTable ReadTable(const HeightmapParams& params, double png_spacing_m) {
  std::ifstream in(params.file, std::ios::binary);
  std::array<char, 4096> head;
  if (std::filesystem::is_directory(params.file)) FailHeightmap(params, 0, "is a folder");
  if (!in) FailHeightmap(params, 0, "cannot read the file");
  in.read(head.data(), head.size());
  const core::FileKind kind =
      core::KindOfContent({head.data(), static_cast<std::size_t>(in.gcount())});
  if (kind.name == core::kPng) return ReadPng(params, png_spacing_m);
  if (!kind.name.empty() && kind.name != core::kEsriGrid)
    FailHeightmap(params, 0, core::NotOfKind(kind, "a 16-bit PNG or an ESRI ASCII grid"));
  return ReadEsriGrid(params);
}

}  // namespace

void FailHeightmap(const HeightmapParams& params, int line, const std::string& rule) {
  throw core::ConfigError({params.file.string(), line, line > 0 ? 1 : 0}, "heightmap", rule);
}

void CheckTableSize(const HeightmapParams& params, double columns, double rows) {
  constexpr double kMostCells = double{kMostNodes} * kMostNodes;
  if (columns * rows <= kMostCells) return;
  FailHeightmap(params, 0,
                fmt::format("has {:g} x {:g} cells; at most {:g} in all: cut it first", columns,
                            rows, kMostCells));
}

Heightmap ReadHeightmap(const HeightmapParams& params, double resolution_m) {
  const HeightTable table = ReadTable(params, resolution_m);
  const TileWindow window = ChooseTile(params, table);
  CheckHeights(params, table, window);
  const bool is_whole = window.columns == table.columns && window.rows == table.rows;
  const std::string of_map = is_whole ? "" : fmt::format(" of {} x {}", table.columns, table.rows);
  const bool keeps_cells =
      table.dx_m == table.dy_m && table.dx_m >= kFinest_m && table.dx_m <= kCoarsest_m;
  if (keeps_cells) {
    CheckNodes(params, window.columns);
    Heightmap map{Cut(table, window), std::nullopt};
    if (!is_whole) {
      map.remark = fmt::format("the tile is {} x {} cells{}, from column {}, row {} in the north",
                               window.columns, window.rows, of_map, window.first_column + 1,
                               window.first_row + 1);
    }
    return map;
  }
  const double edge_m = std::min(window.columns * table.dx_m, window.rows * table.dy_m);
  const long nodes = std::lround(std::floor(edge_m / resolution_m + 1e-9));
  CheckNodes(params, nodes);
  return {Resample(table, window, static_cast<int>(nodes), resolution_m),
          fmt::format("the tile is resampled to {} m from {} x {} cells{} of {:g} x {:g} m",
                      resolution_m, window.columns, window.rows, of_map, table.dx_m, table.dy_m)};
}

}  // namespace scoria::terrains
