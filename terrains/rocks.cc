// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/rocks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scoria::terrains {
namespace {

using core::Rng;
using std::numbers::pi;

/// Draws diameters by the inverse of RockDensity, from a table.
class DiameterLaw {
 public:
  explicit DiameterLaw(const RockParams& rocks) {
    const double ratio = rocks.max_diameter_m / rocks.min_diameter_m;
    for (int i = 0; i <= kPoints; ++i) {
      diameters_m_.push_back(rocks.min_diameter_m * std::pow(ratio, i / double{kPoints}));
      densities_.push_back(RockDensity(rocks, diameters_m_.back()));
    }
  }
  [[nodiscard]] double Draw(Rng& rng) const {
    const double target = rng.NextUniform() * densities_.front();
    const auto above = std::lower_bound(densities_.begin(), densities_.end(), target,
                                        [](double density, double t) { return density > t; });
    const auto i = std::max<std::ptrdiff_t>(1, above - densities_.begin());
    const auto at = static_cast<std::size_t>(i);
    const double share = (densities_[at - 1] - target) / (densities_[at - 1] - densities_[at]);
    return diameters_m_[at - 1] + share * (diameters_m_[at] - diameters_m_[at - 1]);
  }

 private:
  static constexpr int kPoints = 400;
  std::vector<double> diameters_m_, densities_;
};

/// Rocks by the metre in which they lie, to find neighbours.
class RockIndex {
 public:
  RockIndex(double edge_m, double cell_m)
      : edge_m_(edge_m),
        cell_m_(cell_m),
        cells_(static_cast<int>(std::ceil(edge_m / cell_m))),
        lists_(static_cast<std::size_t>(cells_ * cells_)) {}
  void Add(const Rock& rock) {
    lists_[Index(Cell(rock.p_W.x()), Cell(rock.p_W.y()))].push_back(rock);
  }
  /// A rock whose centre lies within the larger of the two covers about half of the smaller.
  [[nodiscard]] bool Overlaps(const Rock& rock) const {
    for (int r = -1; r <= 1; ++r) {
      for (int c = -1; c <= 1; ++c) {
        const int column = Cell(rock.p_W.x()) + c, row = Cell(rock.p_W.y()) + r;
        if (column < 0 || row < 0 || column >= cells_ || row >= cells_) continue;
        for (const Rock& other : lists_[Index(column, row)]) {
          const double reach_m = 0.5 * std::max(rock.diameter_m, other.diameter_m);
          if ((rock.p_W - other.p_W).norm() < reach_m) return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] int Cell(double coordinate_m) const {
    return std::clamp(static_cast<int>((coordinate_m + 0.5 * edge_m_) / cell_m_), 0, cells_ - 1);
  }
  [[nodiscard]] std::size_t Index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(cells_) +
           static_cast<std::size_t>(column);
  }
  double edge_m_, cell_m_;
  int cells_;
  std::vector<std::vector<Rock>> lists_;
};

/// Height at a place, of the nearest node.
double NearestHeight(const Grid& grid, const Vec2& p_W) {
  const Vec2 from_corner = (p_W - grid.Position(0, 0)) / grid.spacing_m;
  return grid.at(std::clamp(static_cast<int>(std::lround(from_corner.x())), 0, grid.nodes - 1),
                 std::clamp(static_cast<int>(std::lround(from_corner.y())), 0, grid.nodes - 1));
}

}  // namespace

double RockDensity(const RockParams& rocks, double above_diameter_m) {
  const double k = rocks.area_fraction, q = 1.79 + 0.152 / k;
  constexpr int kPanels = 64;  // Simpson, in log D: the integrand is smooth there
  const double low = std::log(above_diameter_m), high = std::log(rocks.max_diameter_m);
  if (high <= low) return 0.0;
  const auto density = [&](double log_d) {
    const double d = std::exp(log_d);
    return 4.0 * k * q * std::exp(-q * d) / (pi * d);  // n(D) dD = n(D) D dlogD
  };
  const double h = (high - low) / kPanels;
  double sum = density(low) + density(high);
  for (int i = 1; i < kPanels; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * density(low + i * h);
  return sum * h / 3.0;
}

std::vector<Rock> DrawRocks(const RockParams& params, double edge_m, Rng rng) {
  std::vector<Rock> rocks;
  if (params.area_fraction <= 0.0) return rocks;
  constexpr double kMinBurial = 0.2, kMaxBurial = 0.5;  // of the height
  constexpr double kMinAspect = 0.6;
  constexpr int kTries = 30;  // to find a free place; a crowded ground keeps the last one
  const DiameterLaw law(params);
  RockIndex placed(edge_m, std::max(0.5, params.max_diameter_m));
  const int count = rng.NextPoisson(RockDensity(params, params.min_diameter_m) * edge_m * edge_m);
  for (int i = 0; i < count; ++i) {
    Rock rock;
    rock.diameter_m = law.Draw(rng);
    rock.height_m = params.height_ratio * rock.diameter_m;
    rock.aspect = rng.NextUniform(kMinAspect, 1.0);
    rock.yaw_rad = rng.NextUniform(0.0, pi);
    rock.burial = rng.NextUniform(kMinBurial, kMaxBurial);
    for (int attempt = 0; attempt < kTries; ++attempt) {
      rock.p_W = {rng.NextUniform(-0.5, 0.5) * edge_m, rng.NextUniform(-0.5, 0.5) * edge_m};
      if (!placed.Overlaps(rock)) break;
    }
    placed.Add(rock);
    rocks.push_back(rock);
  }
  return rocks;
}

Grid AddRocks(Grid& heights, const std::vector<Rock>& rocks) {
  Grid presence(heights.nodes, heights.spacing_m);
  const Grid bare = heights;
  for (const Rock& rock : rocks) {
    // Half an ellipsoid, so wide that the part above the ground has the rock's diameter.
    const double widening = 1.0 / std::sqrt(1.0 - rock.burial * rock.burial);
    const double a = 0.5 * widening * rock.diameter_m / std::sqrt(rock.aspect);
    const double b = 0.5 * widening * rock.diameter_m * std::sqrt(rock.aspect);
    const double foot_m = NearestHeight(bare, rock.p_W) - rock.burial * rock.height_m;
    const double c = std::cos(rock.yaw_rad), s = std::sin(rock.yaw_rad);
    ForNodesNear(heights, rock.p_W, a, [&](int column, int row, const Vec2& p_W) {
      const Vec2 d = p_W - rock.p_W;
      const double u = (c * d.x() + s * d.y()) / a, v = (-s * d.x() + c * d.y()) / b;
      const double inside = 1.0 - u * u - v * v;
      if (inside <= 0.0) return;
      const double top_m = foot_m + rock.height_m * std::sqrt(inside);
      if (inside >= rock.burial * rock.burial) presence.at(column, row) = 1.0;
      heights.at(column, row) = std::max(heights.at(column, row), top_m);
    });
  }
  return presence;
}

}  // namespace scoria::terrains
