// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/plots/gnuplot.h"
#include "core/math/types.h"
#include "terrains/heightfield.h"

namespace scoria::analysis {

/// Where something happened to an arm, m in W.
struct MapSeries {
  std::string arm;
  std::vector<Vec2> points;
};

struct GroundMap {
  std::string name, title;
  std::vector<Vec2> route;        // closed; m in W
  std::vector<MapSeries> series;  // one per arm of the campaign, in its order
};

/// Shaded relief, the route, and the arms' points, whose number the key holds.
/// @pre  there is a point.
[[nodiscard]] Figure DrawGroundMap(const GroundMap& map, const terrains::Heightfield& ground);

}  // namespace scoria::analysis
