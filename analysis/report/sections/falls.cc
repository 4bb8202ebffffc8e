// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "analysis/plots/ground_map.h"
#include "analysis/plots/rate_plot.h"
#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/study/fall_groups.h"
#include "core/config/archive.h"
#include "core/files.h"
#include "terrains/generator.h"

namespace scoria::analysis {
namespace {

using Point = std::vector<std::string>;

/// "roughness 1, speed 0.3", without the free axis.
std::string Others(const std::vector<Axis>& axes, std::size_t free, const Point& point) {
  std::string name;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (i != free)
      name += fmt::format("{}{} {}", name.empty() ? "" : ", ", axes[i].label, point[i]);
  }
  return name;
}

const Cell& CellAt(const ReportInput& input, const std::string& arm, const Point& point) {
  return *std::find_if(input.cells.begin(), input.cells.end(),
                       [&](const Cell& c) { return c.arm == arm && c.point == point; });
}

/// Along the free axis, the others fixed.
CaptionedFigure RateFigure(const ReportInput& input, std::size_t free, const Point& fixed) {
  const Axis& axis = input.results.axes[free];
  const std::string others = Others(input.results.axes, free, fixed);
  RatePlot plot;
  plot.name = "falls_" + core::FileNameOf(axis.key + (others.empty() ? "" : "_" + others));
  plot.title = others.empty() ? "Falls per metre" : "Falls per metre, " + others;
  plot.x_label = axis.label;
  plot.y_label = "falls per metre";
  for (const std::string& value : axis.values) plot.x.push_back(std::stod(value));
  for (const std::string& arm : input.results.arms) {
    RateSeries& series = plot.series.emplace_back();
    series.arm = arm;
    for (const std::string& value : axis.values) {
      Point point = fixed;
      point[free] = value;
      const RateEstimate& falls = CellAt(input, arm, point).falls;
      series.rates.push_back(falls.exposure > 0.0 ? std::optional(falls) : std::nullopt);
    }
  }
  return {DrawRates(plot),
          "Bars: exact 95 % Poisson intervals. A triangle marks an arm that did not fall there: it "
          "points at the upper bound of its rate."};
}

bool IsDrawn(const Axis& axis) { return axis.IsNumeric() && axis.values.size() > 1; }

/// One per numeric axis and combination of the others.
void AppendRates(const ReportInput& input, Blocks& blocks) {
  const std::vector<Axis>& axes = input.results.axes;
  for (std::size_t free = 0; free < axes.size(); ++free) {
    if (!IsDrawn(axes[free])) continue;
    std::vector<Axis> others = axes;
    others[free].values = {axes[free].values.front()};
    for (const Point& fixed : AllPoints(others)) blocks.push_back(RateFigure(input, free, fixed));
  }
}

/// From its episode's scenario.yaml. Errors: std::exception.
terrains::Heightfield MakeGroundAgain(const EpisodeRecord& e) {
  const core::ConfigNode scenario = core::LoadConfig(e.folder / "scenario.yaml");
  const core::ConfigNode* terrain = scenario.Find("terrain");
  const core::ConfigNode* seed = scenario.Find("seed");
  if (terrain == nullptr || seed == nullptr)
    throw std::runtime_error("scenario.yaml names no terrain or no seed");
  const auto params = core::ReadConfig<terrains::TerrainParams>(*terrain);
  const std::uint64_t number = std::stoull(seed->scalar);
  if (terrains::GroundId(params, number) != e.ground)
    throw std::runtime_error("its heightmap has changed since");
  return terrains::GenerateTerrain(params, number, 0);
}

CaptionedFigure MapFigure(const ReportInput& input, const EpisodeRecord& e,
                          const std::vector<FallGroup>& groups) {
  GroundMap map;
  map.name = "fall_map_" + core::FileNameOf(e.ground);
  map.title = fmt::format("Falls on the ground of seed {}", e.seed);
  map.route = e.route;
  std::size_t count = 0;
  for (const std::string& arm : input.results.arms) {
    MapSeries& series = map.series.emplace_back();
    series.arm = arm;
    for (const FallGroup& group : groups) {
      for (std::size_t i = 0; i < group.size(); ++i) {
        if (group.arm[i] == arm) series.points.push_back(group.p_WB[i]);
      }
    }
    count += series.points.size();
  }
  return {DrawGroundMap(map, MakeGroundAgain(e)),
          fmt::format("{} {} at {} {}. Falls within 1 m of each other are one place.", count,
                      count == 1 ? "fall" : "falls", groups.size(),
                      groups.size() == 1 ? "place" : "places")};
}

/// The grounds with the most falls.
void AppendMaps(const ReportInput& input, Blocks& blocks) {
  constexpr std::size_t kMost = 4;
  std::map<std::string, std::vector<FallGroup>> groups;  // by ground
  std::map<std::string, std::size_t> falls;
  for (FallGroup& group : GroupFalls(input.results)) {
    falls[group.ground] += group.size();
    groups[group.ground].push_back(std::move(group));
  }
  std::vector<std::string> grounds;
  for (const auto& [ground, count] : falls) grounds.push_back(ground);
  std::stable_sort(grounds.begin(), grounds.end(), [&](const std::string& a, const std::string& b) {
    return falls.at(a) > falls.at(b);
  });
  grounds.resize(std::min(grounds.size(), kMost));
  const auto& episodes = input.results.episodes;
  for (const std::string& ground : grounds) {
    const auto e = std::find_if(episodes.begin(), episodes.end(),
                                [&](const EpisodeRecord& r) { return r.ground == ground; });
    try {
      blocks.push_back(MapFigure(input, *e, groups.at(ground)));
    } catch (const std::exception& error) {
      blocks.push_back(
          Paragraph{fmt::format("Falls on the ground of seed {}: this map could not be drawn: {}",
                                e->seed, error.what())});
    }
  }
}

std::optional<std::string> WhyNoFalls(const ReportInput& input) {
  const auto& axes = input.results.axes;
  if (std::any_of(axes.begin(), axes.end(), IsDrawn)) return std::nullopt;
  if (!GroupFalls(input.results).empty()) return std::nullopt;
  if (auto reason = WhyNotValid(input, "falls")) return reason;
  const auto& episodes = input.results.episodes;
  const bool fell = std::any_of(episodes.begin(), episodes.end(), [](const EpisodeRecord& e) {
    return e.metrics.outcome && e.metrics.outcome->falls > 0;
  });
  const std::string falls =
      fell ? "the results do not say where the falls were" : "no episode fell";
  return falls + ", and no number was swept that falls could be drawn against";
}

Blocks BuildFalls(const ReportInput& input) {
  Blocks blocks;
  AppendRates(input, blocks);
  AppendMaps(input, blocks);
  return blocks;
}

}  // namespace

Section FallsSection() { return {"falls", "Falls", WhyNoFalls, BuildFalls}; }

}  // namespace scoria::analysis
