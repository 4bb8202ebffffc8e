// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/fall_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "analysis/study/fall_groups.h"
#include "core/config/archive.h"
#include "core/files.h"
#include "terrains/generator.h"

namespace scoria::analysis {
namespace {

using Rows = std::vector<std::vector<double>>;

std::optional<terrains::Heightfield> MakeGroundAgain(const EpisodeRecord& e) {
  try {
    const core::ConfigNode scenario = core::LoadConfig(e.folder / "scenario.yaml");
    const core::ConfigNode* terrain = scenario.Find("terrain");
    const core::ConfigNode* seed = scenario.Find("seed");
    if (terrain == nullptr || seed == nullptr) return std::nullopt;
    const auto params = core::ReadConfig<terrains::TerrainParams>(*terrain);
    const std::uint64_t number = std::stoull(seed->scalar);
    if (terrains::GroundId(params, number) != e.ground) return std::nullopt;  // a changed heightmap
    return terrains::GenerateTerrain(params, number, 0);
  } catch (const std::exception&) {
    return std::nullopt;  // a map less is no reason to lose the report
  }
}

struct Box {
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();
};

/// A square around route and falls.
Box BoxAround(const std::vector<Vec2>& points) {
  constexpr double kMargin_m = 1.0;
  Vec2 low = points.front(), high = points.front();
  for (const Vec2& p : points) {
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
      const Vec2 p =
          box.low +
          (box.high - box.low).cwiseProduct(Vec2(i + 0.5, j + 0.5) / static_cast<double>(kPixels));
      const Vec2 gradient = ground.At(p.x(), p.y()).gradient;
      const Vec3 n_W = Vec3(-gradient.x(), -gradient.y(), 1.0).normalized();
      rows.push_back({p.x(), p.y(), std::max(0.0, n_W.dot(light_W))});
    }
  }
  return rows;
}

CaptionedFigure Map(const CampaignResults& results, const EpisodeRecord& e,
                    const std::vector<FallGroup>& groups, const terrains::Heightfield& ground) {
  std::vector<Vec2> points = e.route;
  std::map<std::string, Rows> falls;
  std::size_t count = 0;
  for (const FallGroup& group : groups) {
    for (std::size_t i = 0; i < group.size(); ++i) {
      points.push_back(group.p_WB[i]);
      falls[group.arm[i]].push_back({group.p_WB[i].x(), group.p_WB[i].y()});
      ++count;
    }
  }
  const Box box = BoxAround(points);
  Figure figure("fall_map_" + core::FileNameOf(e.ground),
                fmt::format("Falls on the ground of seed {}", e.seed), 640, 640);
  figure.Data("ground", Shade(ground, box));
  Rows route;
  for (const Vec2& p : e.route) route.push_back({p.x(), p.y()});
  if (!route.empty()) route.push_back(route.front());
  std::string plots = "$ground u 1:2:3 w image notitle";
  if (!route.empty()) {
    figure.Data("route", route);
    plots += ", $route u 1:2 w l lw 1.5 lc rgb '#f0e442' t 'route'";
  }
  for (std::size_t a = 0; a < results.arms.size(); ++a) {
    const auto of_arm = falls.find(results.arms[a]);
    if (of_arm == falls.end()) continue;
    figure.Data(fmt::format("f{}", a), of_arm->second);
    plots += fmt::format(", $f{} u 1:2 w p pt {} ps 1.1 lw 1.5 lc rgb '{}' t '{} ({})'", a,
                         4 + 2 * a, ArmColour(a), Escape(results.arms[a]), of_arm->second.size());
  }
  figure.Line("set palette gray; unset colorbox; set cbrange [0:1]; set size ratio -1; unset grid");
  figure.Line(fmt::format("set xrange [{:.2f}:{:.2f}]; set yrange [{:.2f}:{:.2f}]", box.low.x(),
                          box.high.x(), box.low.y(), box.high.y()));
  figure.Line("set xlabel 'x [m]'; set ylabel 'y [m]'; set key outside bottom center horizontal");
  figure.Line(fmt::format("set title '{}'", Escape(figure.title())));
  figure.Line("plot " + plots);
  return {std::move(figure),
          fmt::format("{} {} at {} {}. Falls within 1 m of each other are one place.", count,
                      count == 1 ? "fall" : "falls", groups.size(),
                      groups.size() == 1 ? "place" : "places")};
}

}  // namespace

std::vector<CaptionedFigure> FallMaps(const CampaignResults& results) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> grounds;  // of the largest groups first
  std::map<std::string, std::vector<FallGroup>> groups;
  std::map<std::string, std::size_t> falls;
  for (FallGroup& group : GroupFalls(results)) {
    falls[group.ground] += group.size();
    groups[group.ground].push_back(std::move(group));
  }
  for (const auto& [ground, count] : falls) grounds.push_back(ground);
  std::stable_sort(grounds.begin(), grounds.end(), [&](const std::string& a, const std::string& b) {
    return falls.at(a) > falls.at(b);
  });
  grounds.resize(std::min(grounds.size(), kMost));
  std::vector<CaptionedFigure> maps;
  for (const std::string& ground : grounds) {
    const auto e = std::find_if(results.episodes.begin(), results.episodes.end(),
                                [&](const EpisodeRecord& r) { return r.ground == ground; });
    if (const auto heights = MakeGroundAgain(*e))
      maps.push_back(Map(results, *e, groups.at(ground), *heights));
  }
  return maps;
}

}  // namespace scoria::analysis
