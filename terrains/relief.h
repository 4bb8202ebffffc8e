// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/math/types.h"
#include "core/rng.h"
#include "terrains/params.h"

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

/// One rock, as placed. Its outline on the ground has the area of a circle of `diameter_m`.
struct Rock {
  Vec2 p_W = Vec2::Zero();
  double diameter_m = 0.0, height_m = 0.0;
  double aspect = 1.0, yaw_rad = 0.0;  // plan, short over long axis
  double burial = 0.0;                 // share of the height below the ground
};

/// Number of rocks per square metre with diameter above D, for D in [min_diameter_m,
/// max_diameter_m]. Source: [Golombek1997], differentiated and divided by the area of one rock.
[[nodiscard]] double RockDensity(const RockParams& rocks, double above_diameter_m);

/// The rocks of a square of that edge: Poisson in number, no two of which cover half of each other.
[[nodiscard]] std::vector<Rock> DrawRocks(const RockParams& params, double edge_m, core::Rng rng);

// Each adds one kind of relief in metres, before any scaling.
void AddRopes(Grid& heights, const RopeParams& params, core::Rng rng);
void AddGullies(Grid& heights, const GullyParams& params, double downhill_rad, core::Rng rng);
void AddCraters(Grid& heights, const CraterParams& params, core::Rng rng);
void AddCells(Grid& heights, const CellParams& params, core::Rng rng);
void AddRipples(Grid& heights, const RippleParams& params, const Grid& presence);

/// Stands the rocks on the ground. @returns 1 where a rock lies, 0 elsewhere.
Grid AddRocks(Grid& heights, const std::vector<Rock>& rocks);

/// RMS height difference at a lag that params ask for: of their spectrum without a longest wave.
[[nodiscard]] double TargetDeviation(const RoughnessParams& params, double lag_m);

/// Adds a Gaussian field with random phases so that the whole ground has the deviogram of
/// TargetDeviation. Other relief (forms, ripples, rocks) stands in `other` and takes its share: the
/// field's spectrum starts from the self-affine law and is fitted, within its band, to what is
/// missing at lags up to a quarter of the longest wave. Where other relief alone is rougher than
/// the target, the field fades.
void AddRoughness(Grid& heights, const RoughnessParams& params, const Grid& other, core::Rng rng);

/// A smooth random field without mean, for the outlines of patches.
[[nodiscard]] Grid DrawPatchField(int nodes, double spacing_m, core::Rng rng);

/// How low each node lies against its surroundings of some metres.
[[nodiscard]] Grid CalcHollows(const Grid& heights);

/// The share of a patch at every node, 0 to 1: where `field` is highest, on `fraction` of the area,
/// with edges that blend over `blend_m`.
[[nodiscard]] Grid CoverHighest(const Grid& field, double fraction, double blend_m);

/// Ramps of three nodes in place of steps.
[[nodiscard]] Grid SoftenEdges(const Grid& presence);

/// Lowers peaks until no two neighbours differ by more than the slope allows.
void LimitSlope(Grid& heights, double max_slope_rad);

/// RMS height difference at a lag along both axes, a plane of that gradient removed.
[[nodiscard]] double CalcDeviation(const Grid& heights, double lag_m, const Vec2& plane);

/// Gradient of the plane that fits best.
[[nodiscard]] Vec2 FitPlane(const Grid& heights);

}  // namespace scoria::terrains
