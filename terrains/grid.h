// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/types.h"

namespace scoria::terrains {

/// A number at every node of a square grid centred on the origin.
struct Grid {
  int nodes = 0;
  double spacing_m = 0.0;
  std::vector<double> values;  // row * nodes + column, column along +x

  Grid(int n, double spacing)
      : nodes(n),
        spacing_m(spacing),
        values(static_cast<std::size_t>(n) * static_cast<std::size_t>(n), 0.0) {}
  [[nodiscard]] double& at(int column, int row) { return values[Index(column, row)]; }
  [[nodiscard]] double at(int column, int row) const { return values[Index(column, row)]; }
  [[nodiscard]] Vec2 Position(int column, int row) const {
    const double half_m = 0.5 * (nodes - 1) * spacing_m;
    return {column * spacing_m - half_m, row * spacing_m - half_m};
  }
  [[nodiscard]] double edge_m() const { return nodes * spacing_m; }

 private:
  [[nodiscard]] std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(nodes) +
           static_cast<std::size_t>(column);
  }
};

/// Calls visit(column, row, p_W) for every node within reach_m of a place.
template <class Visit>
void ForNodesNear(const Grid& grid, const Vec2& p_W, double reach_m, Visit visit) {
  const Vec2 corner = grid.Position(0, 0);
  const auto first = [&](double coordinate, double origin) {
    return std::max(0,
                    static_cast<int>(std::ceil((coordinate - reach_m - origin) / grid.spacing_m)));
  };
  const auto last = [&](double coordinate, double origin) {
    return std::min(grid.nodes - 1,
                    static_cast<int>(std::floor((coordinate + reach_m - origin) / grid.spacing_m)));
  };
  for (int row = first(p_W.y(), corner.y()); row <= last(p_W.y(), corner.y()); ++row) {
    for (int column = first(p_W.x(), corner.x()); column <= last(p_W.x(), corner.x()); ++column) {
      visit(column, row, grid.Position(column, row));
    }
  }
}

/// Running mean over 2 radius + 1 nodes along rows, then columns; borders continue.
[[nodiscard]] Grid BoxBlur(const Grid& in, int radius);

/// RMS height difference at a lag along both axes, a plane of that gradient removed.
[[nodiscard]] double CalcDeviation(const Grid& heights, double lag_m, const Vec2& plane);

/// Gradient of the plane that fits best.
[[nodiscard]] Vec2 FitPlane(const Grid& heights);

}  // namespace scoria::terrains
