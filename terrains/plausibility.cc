// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/plausibility.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scoria::terrains {
namespace {

// Challenger Deep is at -10.9 km; Olympus Mons at 21.2 km over the datum of Mars.
constexpr double kLowest_m = -11000.0, kHighest_m = 22000.0;
// What raster tools write where nothing was measured; all of them whole numbers that a height in
// metres hardly ever is to the last digit.
constexpr std::array kUsualNoData = {-9999.0, -32768.0, -32767.0, 32767.0, -99999.0, 9999.0};
constexpr double kHighestStep_m = 50.0;  // between two cells; more in cells over 5 m
constexpr double kSteep = 5.0;           // step over cell: 79 degrees

/// What one or two cells may rise over all their neighbours: ten times their width while that is
/// some metres, as of a boulder or a tree, and five times the width of a coarse cell.
double HighestSpike(double cell_m) {
  constexpr double kSlender = 10.0, kCoarse = 5.0, kTree_m = 10.0;
  return std::min(kSlender * cell_m, std::max(kTree_m, kCoarse * cell_m));
}

class HeightCheck {
 public:
  HeightCheck(const HeightmapParams& params, const HeightTable& table, const TileWindow& window)
      : params_(params),
        table_(table),
        window_(window),
        spike_m_(HighestSpike(std::max(table.dx_m, table.dy_m))),
        step_m_(std::max(kHighestStep_m, 10.0 * std::max(table.dx_m, table.dy_m))) {}

  void Run() const {
    ForCells([&](int column, int row) { CheckCell(column, row); });
    CheckUnits();
    ForCells([&](int column, int row) { CheckNeighbours(column, row); });
  }

 private:
  template <class Visit>
  void ForCells(Visit visit) const {
    for (int row = window_.first_row; row < window_.first_row + window_.rows; ++row) {
      for (int column = window_.first_column; column < window_.first_column + window_.columns;
           ++column)
        visit(column, row);
    }
  }

  [[noreturn]] void Fail(int column, int row, const std::string& what) const {
    const int line = table_.lines.empty() ? 0 : table_.lines[static_cast<std::size_t>(row)];
    FailHeightmap(params_, line, fmt::format("row {}, value {} {}", row + 1, column + 1, what));
  }

  void CheckCell(int column, int row) const {
    using Cell = HeightTable::Cell;
    const Cell cell =
        table_.cells.empty() ? Cell::kHeight : table_.cells[table_.Index(column, row)];
    const double height_m = table_.at(column, row);
    if (cell == Cell::kNoData)
      Fail(column, row, "is NODATA; fill the gaps first, or choose a tile without");
    if (cell == Cell::kNotFinite)
      Fail(column, row, fmt::format("is {}; every height must be a number", height_m));
    if (std::find(kUsualNoData.begin(), kUsualNoData.end(), height_m) != kUsualNoData.end())
      Fail(column, row,
           fmt::format("is {}, as gaps are marked; fill the gaps first, or choose a tile without",
                       height_m));
    if (!(height_m >= kLowest_m && height_m <= kHighest_m)) {
      Fail(column, row,
           fmt::format("is {} m; heights of Earth, Moon and Mars lie in [{}, {}] m", height_m,
                       kLowest_m, kHighest_m));
    }
  }

  /// No step beyond the limit to the neighbours east and south, and at least two of the eight
  /// neighbours near.
  void CheckNeighbours(int column, int row) const {
    const double height_m = table_.at(column, row);
    int near = 0;
    for (int dr = -1; dr <= 1; ++dr) {
      for (int dc = -1; dc <= 1; ++dc) {
        if ((dr == 0 && dc == 0) || !Contains(column + dc, row + dr)) continue;
        const double step_m = std::abs(table_.at(column + dc, row + dr) - height_m);
        near += step_m <= spike_m_ ? 1 : 0;
        if (dr + dc == 1 && dr * dc == 0 && step_m > step_m_) {
          Fail(column, row,
               fmt::format("is {} m, its neighbour {}: {:g} m in one cell; fill gaps first",
                           height_m, table_.at(column + dc, row + dr), step_m));
        }
      }
    }
    if (near >= 2) return;
    Fail(column, row,
         fmt::format("is {} m, over {:g} m from all but {} of its neighbours: a spike or a pit; "
                     "remove it first",
                     height_m, spike_m_, near));
  }

  /// Metres up, but degrees or kilometres across; or millimetres up.
  void CheckUnits() const {
    std::size_t steps = 0, steep = 0;
    ForCells([&](int column, int row) {
      if (!Contains(column + 1, row)) return;
      ++steps;
      const double step_m = std::abs(table_.at(column + 1, row) - table_.at(column, row));
      if (step_m > kSteep * table_.dx_m) ++steep;
    });
    if (2 * steep <= steps) return;
    FailHeightmap(params_, 0,
                  fmt::format("most neighbours differ by more than {} times their distance; are "
                              "cells and heights both in metres?",
                              kSteep));
  }

  [[nodiscard]] bool Contains(int column, int row) const {
    return column >= window_.first_column && row >= window_.first_row &&
           column < window_.first_column + window_.columns &&
           row < window_.first_row + window_.rows;
  }

  const HeightmapParams& params_;
  const HeightTable& table_;
  const TileWindow& window_;
  double spike_m_, step_m_;  // what is refused is higher
};

}  // namespace

void CheckHeights(const HeightmapParams& params, const HeightTable& table,
                  const TileWindow& window) {
  HeightCheck(params, table, window).Run();
}

}  // namespace scoria::terrains
