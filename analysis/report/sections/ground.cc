// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "analysis/report/sections/sections.h"
#include "core/math/angles.h"

namespace scoria::analysis {
namespace {

using terrains::TerrainStatistics;

struct Quantity {
  const char* title;
  double TerrainStatistics::*value;
  double scale;
  int digits;
};
constexpr std::array<Quantity, 6> kQuantities = {
    {{"RMS height difference at 0.1 m [m]", &TerrainStatistics::nu_10cm_m, 1.0, 3},
     {"at 0.25 m [m]", &TerrainStatistics::nu_25cm_m, 1.0, 3},
     {"at 1 m [m]", &TerrainStatistics::nu_1m_m, 1.0, 3},
     {"Hurst exponent", &TerrainStatistics::hurst, 1.0, 2},
     {"mean slope at the grid spacing [deg]", &TerrainStatistics::slope_mean_rad,
      core::kDegreesPerRad, 1},
     {"95 % of slopes below [deg]", &TerrainStatistics::slope_95_rad, core::kDegreesPerRad, 1}}};

/// Over the episodes.
std::string RangeText(const CampaignResults& results, const Quantity& q) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const EpisodeRecord& e : results.episodes) {
    const double value = q.scale * e.terrain.*q.value;
    if (!e.has_metrics || std::isnan(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return "–";
  const std::string from = fmt::format("{:.{}f}", low, q.digits);
  const std::string to = fmt::format("{:.{}f}", high, q.digits);
  return from == to ? from : from + " to " + to;
}

/// Sum of the fractions of a material, and the number of grounds that have it.
std::map<std::string, std::pair<double, int>> MaterialsOf(const CampaignResults& results) {
  std::map<std::string, std::pair<double, int>> materials;
  for (const EpisodeRecord& e : results.episodes) {
    for (const auto& [name, fraction] : e.terrain.materials) {
      materials[name].first += fraction;
      ++materials[name].second;
    }
  }
  return materials;
}

std::optional<std::string> WhyNoGround(const ReportInput& input) {
  if (MaterialsOf(input.results).empty()) return "no episode left numbers of its ground";
  return std::nullopt;
}

Blocks BuildGround(const ReportInput& input) {
  Table table{{"quantity", "value over the episodes"}, {}};
  for (const Quantity& q : kQuantities)
    table.rows.push_back({q.title, RangeText(input.results, q)});
  for (const auto& [name, sum] : MaterialsOf(input.results)) {
    table.rows.push_back(
        {name + " [% of the area]", fmt::format("{:.1f}", 100.0 * sum.first / sum.second)});
  }
  return {table,
          Note{"Heights with their mean plane removed; materials in the mean of the grounds that "
               "have them."}};
}

}  // namespace

Section GroundSection() {
  return {"ground", "Ground, as measured on its grids", WhyNoGround, BuildGround};
}

}  // namespace scoria::analysis
