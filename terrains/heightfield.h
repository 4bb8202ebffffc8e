// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/math/types.h"

namespace scoria::terrains {

/// What a foot meets: Coulomb friction, and a pressure that grows with sinkage. A sphere that has
/// sunk by z presses with F = k_s A(z) z, A being the area of its cut at the surface.
struct Material {
  std::string name = "rock";
  double friction = 0.8;
  double stiffness_N_per_m3 = 1e9;  // k_s
  double damping_ratio = 0.5;       // of a quarter of the robot on that spring
  double depth_m = 0.0;             // thickness of the layer; the substrate is below
};

/// The ground at one place: a layer over the substrate, both with the law of Material.
struct GroundSample {
  double friction = 0.0;
  double layer_N_per_m3 = 0.0, substrate_N_per_m3 = 0.0;
  double depth_m = 0.0;
  double damping_ratio = 0.0;
};

/// Share of the ground that a material covers, one byte per grid node: 255 is all of it.
struct Cover {
  Material material;
  std::vector<std::uint8_t> share;  // as heights: row * nodes + column
};

/// Height over a square tile centred on the origin of W, on a regular grid, with the materials that
/// lie on it. Between grid nodes the surface is the bicubic (Catmull-Rom) interpolant, so slopes
/// are continuous; covers are bilinear, and properties mix with them (stiffness by its logarithm),
/// so that no edge of a patch is a step. Outside the tile the border continues.
class Heightfield {
 public:
  struct Sample {
    double z_m = 0.0;
    Vec2 gradient = Vec2::Zero();  // dz/dx, dz/dy
  };

  /// `heights_m[row * nodes + column]`, column along +x, row along +y, node spacing `resolution_m`.
  /// @pre the shares of all covers sum to at most 255 at every node.
  Heightfield(int nodes, double resolution_m, std::vector<double> heights_m, Material substrate,
              std::vector<Cover> covers = {});

  [[nodiscard]] int nodes() const noexcept { return nodes_; }
  [[nodiscard]] double resolution_m() const noexcept { return resolution_m_; }
  [[nodiscard]] double half_size_m() const noexcept { return 0.5 * (nodes_ - 1) * resolution_m_; }
  [[nodiscard]] const Material& substrate() const noexcept { return substrate_; }
  [[nodiscard]] const std::vector<Cover>& covers() const noexcept { return covers_; }
  [[nodiscard]] const std::vector<double>& heights_m() const noexcept { return heights_m_; }
  [[nodiscard]] double min_m() const noexcept { return min_m_; }
  [[nodiscard]] double max_m() const noexcept { return max_m_; }
  [[nodiscard]] double NodeHeight(int column, int row) const noexcept;
  [[nodiscard]] Vec2 NodePosition(int column, int row) const noexcept;

  [[nodiscard]] Sample At(double x_m, double y_m) const noexcept;
  [[nodiscard]] double HeightAt(double x_m, double y_m) const noexcept { return At(x_m, y_m).z_m; }
  [[nodiscard]] GroundSample GroundAt(double x_m, double y_m) const noexcept;

 private:
  int nodes_;
  double resolution_m_;
  std::vector<double> heights_m_;
  Material substrate_;
  std::vector<Cover> covers_;
  double min_m_, max_m_;
};

}  // namespace scoria::terrains
