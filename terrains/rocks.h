// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/rng.h"
#include "terrains/grid.h"
#include "terrains/params.h"

namespace scoria::terrains {

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

/// Stands the rocks on the ground. @returns 1 where a rock lies, 0 elsewhere.
Grid AddRocks(Grid& heights, const std::vector<Rock>& rocks);

}  // namespace scoria::terrains
