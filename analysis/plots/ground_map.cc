// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/ground_map.h"

#include <algorithm>

#include <fmt/format.h>

#include "analysis/plots/style.h"

namespace scoria::analysis {
namespace {

using Rows = std::vector<std::vector<double>>;

Rows RowsOf(const std::vector<Vec2>& points) {
  Rows rows;
  for (const Vec2& p : points) rows.push_back({p.x(), p.y()});
  return rows;
}

struct Box {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
};

/// A square around route and points.
Box BoxAround(const GroundMap& map) {
  constexpr double kMargin_m = 1.0;
  std::vector<Vec2> all = map.route;
  for (const MapSeries& s : map.series) all.insert(all.end(), s.points.begin(), s.points.end());
  Vec2 low = all.front(), high = all.front();
  for (const Vec2& p : all) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 centre = 0.5 * (low + high);
  const double half_m = 0.5 * (high - low).maxCoeff() + kMargin_m;
  return {centre - Vec2::Constant(half_m), centre + Vec2::Constant(half_m)};
}

/// Lambert shading with light from the north-west, 0 to 1.
Rows Shade(const terrains::Heightfield& ground, const Box& box) {
  constexpr int kPixels = 200;
  const Vec3 light_W = Vec3(-1.0, 1.0, 1.5).normalized();
  Rows rows;
  for (int j = 0; j < kPixels; ++j) {
    for (int i = 0; i < kPixels; ++i) {
      const Vec2 share = Vec2(i + 0.5, j + 0.5) / static_cast<double>(kPixels);
      const Vec2 p = box.low + (box.high - box.low).cwiseProduct(share);
      const Vec2 gradient = ground.At(p.x(), p.y()).gradient;
      const Vec3 n_W = Vec3(-gradient.x(), -gradient.y(), 1.0).normalized();
      rows.push_back({p.x(), p.y(), std::max(0.0, n_W.dot(light_W))});
    }
  }
  return rows;
}

/// Adds route and points. @returns their pieces of the plot command.
std::string AddMarks(const GroundMap& map, Figure& figure) {
  std::string pieces;
  if (!map.route.empty()) {
    Rows route = RowsOf(map.route);
    route.push_back(route.front());
    figure.Data("route", route);
    pieces += fmt::format(", $route u 1:2 w l lw 1.5 lc rgb '{}' t 'route'", Palette::kYellow);
  }
  for (std::size_t arm = 0; arm < map.series.size(); ++arm) {
    const MapSeries& series = map.series[arm];
    if (series.points.empty()) continue;
    figure.Data(fmt::format("f{}", arm), RowsOf(series.points));
    const ArmStyle style = StyleOfArm(arm);
    pieces +=
        fmt::format(", $f{} u 1:2 w p pt {} ps 1.1 lw 1.5 lc rgb '{}' t '{} ({})'", arm,
                    style.open_symbol, style.colour, Escape(series.arm), series.points.size());
  }
  return pieces;
}

}  // namespace

Figure DrawGroundMap(const GroundMap& map, const terrains::Heightfield& ground) {
  Figure figure(map.name, map.title, 640, 640);
  const Box box = BoxAround(map);
  figure.Data("ground", Shade(ground, box));
  const std::string marks = AddMarks(map, figure);
  figure.Line("set palette gray; unset colorbox; set cbrange [0:1]; set size ratio -1; unset grid");
  figure.Line(fmt::format("set xrange [{:.2f}:{:.2f}]; set yrange [{:.2f}:{:.2f}]", box.low.x(),
                          box.high.x(), box.low.y(), box.high.y()));
  figure.Line("set xlabel 'x [m]'; set ylabel 'y [m]'; set key outside bottom center horizontal");
  figure.Line(fmt::format("set title '{}'", Escape(map.title)));
  figure.Line("plot $ground u 1:2:3 w image notitle" + marks);
  return figure;
}

}  // namespace scoria::analysis
