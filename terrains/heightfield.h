// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/math/types.h"

namespace scoria::terrains {

/// Height over a square tile centred on the origin of W, on a regular grid, with one friction
/// coefficient. Between grid nodes the surface is the bicubic (Catmull-Rom) interpolant, so slopes
/// are continuous. Outside the tile the border height continues.
class Heightfield {
 public:
  struct Sample {
    double z_m = 0.0;
    Vec2 gradient = Vec2::Zero();  // dz/dx, dz/dy
  };

  /// `heights_m[row * nodes + column]`, column along +x, row along +y, node spacing `resolution_m`.
  Heightfield(int nodes, double resolution_m, std::vector<double> heights_m, double friction);

  [[nodiscard]] int nodes() const noexcept { return nodes_; }
  [[nodiscard]] double resolution_m() const noexcept { return resolution_m_; }
  [[nodiscard]] double half_size_m() const noexcept { return 0.5 * (nodes_ - 1) * resolution_m_; }
  [[nodiscard]] double friction() const noexcept { return friction_; }
  [[nodiscard]] const std::vector<double>& heights_m() const noexcept { return heights_m_; }
  [[nodiscard]] double min_m() const noexcept { return min_m_; }
  [[nodiscard]] double max_m() const noexcept { return max_m_; }
  [[nodiscard]] double NodeHeight(int column, int row) const noexcept;
  [[nodiscard]] Vec2 NodePosition(int column, int row) const noexcept;

  [[nodiscard]] Sample At(double x_m, double y_m) const noexcept;
  [[nodiscard]] double HeightAt(double x_m, double y_m) const noexcept { return At(x_m, y_m).z_m; }

 private:
  int nodes_;
  double resolution_m_;
  std::vector<double> heights_m_;
  double friction_;
  double min_m_, max_m_;
};

}  // namespace scoria::terrains
