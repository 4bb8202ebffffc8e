// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace scoria::terrains {
namespace {

using core::Rng;
using std::numbers::pi;

}  // namespace

void AddGullies(Grid& heights, const GullyParams& p, double downhill_rad, Rng rng) {
  const Vec2 down(std::cos(downhill_rad), std::sin(downhill_rad)), across(-down.y(), down.x());
  const double span_m = std::numbers::sqrt2 * heights.edge_m();  // whatever the direction
  const int count = static_cast<int>(std::lround(p.per_20m * span_m / 20.0));
  for (int gully = 0; gully < count; ++gully) {
    const double at_m = span_m * ((gully + rng.NextUniform()) / count - 0.5);
    const double depth_m = rng.NextUniform(p.min_depth_m, p.max_depth_m);
    const double half_m = 0.5 * rng.NextUniform(p.min_width_m, p.max_width_m);
    // It winds and fades: waves of some metres, of random phase.
    const double bend_m = rng.NextUniform(0.3, 1.0), wave_m = rng.NextUniform(8.0, 20.0);
    const double bend_phase = rng.NextUniform(0.0, 2.0 * pi);
    const double fade_m = rng.NextUniform(10.0, 30.0), fade_phase = rng.NextUniform(0.0, 2.0 * pi);
    for (int row = 0; row < heights.nodes; ++row) {
      for (int column = 0; column < heights.nodes; ++column) {
        const Vec2 p_W = heights.Position(column, row);
        const double along = p_W.dot(down), beside = p_W.dot(across) - at_m;
        if (std::abs(beside) >= half_m + bend_m) continue;
        const double off = beside - bend_m * std::sin(2.0 * pi * along / wave_m + bend_phase);
        if (std::abs(off) >= half_m) continue;
        const double strength = 0.5 + 0.5 * std::sin(2.0 * pi * along / fade_m + fade_phase);
        heights.at(column, row) -= strength * depth_m * (1.0 - off * off / (half_m * half_m));
      }
    }
  }
}

void AddCraters(Grid& heights, const CraterParams& p, Rng rng) {
  if (p.per_100m2 == 0.0) return;
  const auto above = [&](double d) { return 0.01 * p.per_100m2 / (d * d); };  // per m^2
  const double most = above(p.min_diameter_m), least = above(p.max_diameter_m);
  const int count = rng.NextPoisson((most - least) * heights.edge_m() * heights.edge_m());
  constexpr double kRim = 0.25, kReach = 2.0;  // rim height over depth; ejecta out to 2 radii
  for (int crater = 0; crater < count; ++crater) {
    const double density = rng.NextUniform(least, most);
    const double diameter_m = std::sqrt(0.01 * p.per_100m2 / density);
    const double radius_m = 0.5 * diameter_m, depth_m = p.depth_ratio * diameter_m;
    const double rim_m = kRim * depth_m;
    const Vec2 centre =
        heights.edge_m() * Vec2(rng.NextUniform(-0.5, 0.5), rng.NextUniform(-0.5, 0.5));
    ForNodesNear(heights, centre, kReach * radius_m, [&](int column, int row, const Vec2& p_W) {
      const double r = (p_W - centre).norm() / radius_m;
      if (r >= kReach) return;
      // A paraboloid from floor to rim; ejecta fall off as r^-3 and end smoothly.
      const double fade = 1.0 - (r - 1.0) / (kReach - 1.0);
      heights.at(column, row) +=
          r < 1.0 ? depth_m * r * r - (depth_m - rim_m) : rim_m * fade / (r * r * r);
    });
  }
}

void AddCells(Grid& heights, const CellParams& p, Rng rng) {
  if (p.amplitude_m == 0.0) return;
  const int cells = static_cast<int>(std::ceil(heights.edge_m() / p.cell_m)) + 1;
  Grid coarse(cells, p.cell_m);
  const int levels = static_cast<int>(std::floor(2.0 * p.amplitude_m / p.step_m + 0.5)) + 1;
  for (double& z : coarse.values) {
    z = -p.amplitude_m +
        p.step_m * std::min(levels - 1, static_cast<int>(rng.NextUniform() * levels));
  }
  for (int row = 0; row < heights.nodes; ++row) {
    for (int column = 0; column < heights.nodes; ++column) {
      const Vec2 at = heights.spacing_m / p.cell_m * Vec2(column, row);
      const int i = static_cast<int>(at.x()), j = static_cast<int>(at.y());
      const double u = at.x() - i, v = at.y() - j;
      heights.at(column, row) += (1 - v) * ((1 - u) * coarse.at(i, j) + u * coarse.at(i + 1, j)) +
                                 v * ((1 - u) * coarse.at(i, j + 1) + u * coarse.at(i + 1, j + 1));
    }
  }
}

void AddRipples(Grid& heights, const RippleParams& p, const Grid& presence) {
  if (p.amplitude_m == 0.0) return;
  const Vec2 wind(std::cos(p.azimuth_rad), std::sin(p.azimuth_rad)), across(-wind.y(), wind.x());
  constexpr double kSkew = 0.5;  // rad: the lee side is steeper
  for (int row = 0; row < heights.nodes; ++row) {
    for (int column = 0; column < heights.nodes; ++column) {
      const double share = presence.at(column, row);
      if (share == 0.0) continue;
      const Vec2 p_W = heights.Position(column, row);
      const double sway = 0.7 * std::sin(2.0 * pi * p_W.dot(across) / (12.0 * p.wavelength_m));
      const double phase = 2.0 * pi * p_W.dot(wind) / p.wavelength_m + sway;
      heights.at(column, row) += share * p.amplitude_m * std::sin(phase + kSkew * std::sin(phase));
    }
  }
}

Grid CalcHollows(const Grid& heights) {
  constexpr double kNear_m = 0.25, kFar_m = 2.0;  // radii of the means that are compared
  const auto radius = [&](double m) {
    return std::clamp(static_cast<int>(m / heights.spacing_m), 1, heights.nodes / 4);
  };
  Grid near = BoxBlur(heights, radius(kNear_m));
  const Grid far = BoxBlur(heights, radius(kFar_m));
  for (std::size_t i = 0; i < near.values.size(); ++i)
    near.values[i] = far.values[i] - near.values[i];
  return near;
}

Grid CoverHighest(const Grid& field, double fraction, double blend_m) {
  Grid cover(field.nodes, field.spacing_m);
  if (fraction <= 0.0) return cover;
  std::vector<double> sorted;
  constexpr std::size_t kEvery = 17;  // a sample is enough for a quantile
  for (std::size_t i = 0; i < field.values.size(); i += kEvery) sorted.push_back(field.values[i]);
  const auto rank =
      std::min(sorted.size() - 1,
               static_cast<std::size_t>((1.0 - fraction) * static_cast<double>(sorted.size())));
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(rank),
                   sorted.end());
  const double threshold = fraction >= 1.0 ? -1e300 : sorted[rank];
  for (std::size_t i = 0; i < field.values.size(); ++i)
    cover.values[i] = field.values[i] > threshold ? 1.0 : 0.0;
  // Two passes of a mean over half the blend make an edge that rises over all of it.
  const int radius = static_cast<int>(std::lround(0.25 * blend_m / field.spacing_m));
  return radius > 0 ? BoxBlur(BoxBlur(cover, radius), radius) : cover;
}

Grid SoftenEdges(const Grid& presence) { return BoxBlur(presence, 1); }

std::size_t LimitSlope(Grid& heights, double max_slope_rad) {
  const std::vector<double> before = heights.values;
  const double step_m = std::tan(max_slope_rad) * heights.spacing_m;
  const int n = heights.nodes;
  const auto lower = [&](int c, int r, int c2, int r2) {
    if (c2 < 0 || r2 < 0 || c2 >= n || r2 >= n) return;
    heights.at(c, r) = std::min(heights.at(c, r), heights.at(c2, r2) + step_m);
  };
  for (int r = 0; r < n; ++r) {
    for (int c = 0; c < n; ++c) lower(c, r, c - 1, r), lower(c, r, c, r - 1);
  }
  for (int r = n - 1; r >= 0; --r) {
    for (int c = n - 1; c >= 0; --c) lower(c, r, c + 1, r), lower(c, r, c, r + 1);
  }
  std::size_t lowered = 0;
  for (std::size_t i = 0; i < before.size(); ++i) lowered += heights.values[i] < before[i] ? 1 : 0;
  return lowered;
}

}  // namespace scoria::terrains
