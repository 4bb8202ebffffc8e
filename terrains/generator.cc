// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/generator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/config/archive.h"
#include "core/files.h"
#include "core/hash.h"
#include "terrains/heightmap.h"
#include "terrains/relief.h"
#include "terrains/spectrum.h"

namespace scoria::terrains {
namespace {

using core::Rng;
using core::Stream;

constexpr double kBlend_m = 0.2;  // width of a patch's edge
constexpr double kWhole = 255.0;  // a full share of a Cover

/// A measured ground, or a level one.
Heightmap BareGround(const TerrainParams& params) {
  if (!params.heightmap.file.empty()) return ReadHeightmap(params.heightmap, params.resolution_m);
  return {
      Grid(static_cast<int>(std::lround(params.size_m / params.resolution_m)), params.resolution_m),
      std::nullopt};
}

/// Relief larger than roughness.
void AddForms(Grid& forms, const TerrainParams& params, std::uint64_t seed, std::uint32_t episode) {
  AddCells(forms, params.cells, Rng(seed, episode, Stream::kCells));
  AddRopes(forms, params.ropes, Rng(seed, episode, Stream::kRopes));
  AddGullies(forms, params.gullies, params.slope_azimuth_rad + std::numbers::pi,
             Rng(seed, episode, Stream::kGullies));
  AddCraters(forms, params.craters, Rng(seed, episode, Stream::kCraters));
}

/// Where ripples lie: on their material first, then around it; without one, anywhere.
Grid RipplePresence(const TerrainParams& params, const std::vector<Grid>& fields, const Grid& like,
                    const Rng& rng) {
  const RippleParams& ripples = params.ripples;
  for (std::size_t i = 0; i < params.patches.size(); ++i) {
    if (params.patches[i].name == ripples.material)
      return CoverHighest(fields[i], ripples.fraction, kBlend_m);
  }
  return CoverHighest(DrawPatchField(like.nodes, like.spacing_m, rng), ripples.fraction, kBlend_m);
}

/// Adds a cover above those that are there: it takes its share of what they leave and of theirs.
void LayOver(std::vector<Cover>& covers, const Material& material, const Grid& share) {
  Cover cover{material, std::vector<std::uint8_t>(share.values.size())};
  for (std::size_t i = 0; i < share.values.size(); ++i) {
    const double own = std::clamp(share.values[i], 0.0, 1.0);
    cover.share[i] = static_cast<std::uint8_t>(std::lround(kWhole * own));
    const double rest = 1.0 - cover.share[i] / kWhole;
    for (Cover& below : covers) below.share[i] = static_cast<std::uint8_t>(below.share[i] * rest);
  }
  covers.push_back(std::move(cover));
}

Grid HeightsOf(const Heightfield& ground) {
  Grid grid(ground.nodes(), ground.resolution_m());
  grid.values = ground.heights_m();
  return grid;
}

/// Least-squares slope of log deviation over log lag.
double FitExponent(const Grid& heights, double first_m, double last_m, const Vec2& plane) {
  constexpr int kLags = 8;
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (int i = 0; i < kLags; ++i) {
    // Lags are whole nodes.
    const double asked_m = first_m * std::pow(last_m / first_m, i / (kLags - 1.0));
    const double lag_m = std::round(asked_m / heights.spacing_m) * heights.spacing_m;
    const double x = std::log(lag_m);
    const double y = std::log(std::max(CalcDeviation(heights, lag_m, plane), 1e-12));
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (kLags * sxy - sx * sy) / (kLags * sxx - sx * sx);
}

void MeasureSlopes(const Grid& heights, TerrainStatistics& stats) {
  std::vector<double> slopes;
  constexpr int kStride = 7;
  for (int r = 1; r + 1 < heights.nodes; r += kStride) {
    for (int c = 1; c + 1 < heights.nodes; c += kStride) {
      const double gx = heights.at(c + 1, r) - heights.at(c - 1, r);
      const double gy = heights.at(c, r + 1) - heights.at(c, r - 1);
      slopes.push_back(std::atan(std::hypot(gx, gy) / (2.0 * heights.spacing_m)));
    }
  }
  for (const double slope : slopes)
    stats.slope_mean_rad += slope / static_cast<double>(slopes.size());
  const auto rank =
      slopes.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(slopes.size()));
  std::nth_element(slopes.begin(), rank, slopes.end());
  stats.slope_95_rad = *rank;
}

}  // namespace

std::string TerrainParams::Problem() const {
  if (size_m < 16.0 * resolution_m) return "size_m must be at least 16 resolution_m";
  if (roughness.nu_1m_m > 0.0 && roughness.max_wavelength_m < 4.0 * resolution_m) {
    return "roughness.max_wavelength_m must be at least 4 resolution_m";
  }
  if (ropes.amplitude_m > 0.0 && ropes.max_wavelength_m < 2.0 * resolution_m) {
    return "ropes.max_wavelength_m must be at least 2 resolution_m";
  }
  std::string names;
  double covered = 0.0;
  for (const PatchParams& patch : patches) {
    covered += patch.fraction;
    if (patch.where == PatchPlace::kAnywhere) names += (names.empty() ? "" : ", ") + patch.name;
  }
  if (covered > 1.0) return fmt::format("patches: fractions sum to {}, more than 1", covered);
  const auto carries_ripples = [&](const PatchParams& patch) {
    return patch.name == ripples.material && patch.where == PatchPlace::kAnywhere;
  };
  const bool known =
      ripples.material.empty() || std::any_of(patches.begin(), patches.end(), carries_ripples);
  if (!known) {
    return fmt::format("ripples.material: unknown \"{}\"; the patches that lie anywhere are: {}",
                       ripples.material, names.empty() ? "none" : names);
  }
  return "";
}

std::vector<std::string> HeightmapRemarks(const Terrain& terrain, const TerrainParams& params) {
  std::vector<std::string> out;
  if (terrain.remark) out.push_back(*terrain.remark);
  if (!params.heightmap.file.empty() && terrain.cut_nodes > 0) {
    out.push_back(fmt::format(
        "{} of {} nodes of the heightmap, steeper than max_slope_rad {}, are lowered to it",
        terrain.cut_nodes, terrain.ground.heights_m().size(), params.max_slope_rad));
  }
  return out;
}

Heightfield GenerateTerrain(const TerrainParams& params, std::uint64_t seed,
                            std::uint32_t episode) {
  return MakeTerrain(params, seed, episode).ground;
}

Terrain MakeTerrain(const TerrainParams& params, std::uint64_t seed, std::uint32_t episode) {
  auto [heights, remark] = BareGround(params);
  AddForms(heights, params, seed, episode);
  Rng patch_rng(seed, episode, Stream::kMaterial);
  std::vector<Grid> fields;
  for (const PatchParams& patch : params.patches) {
    const Rng own(patch_rng.NextU32(), episode, Stream::kMaterial);
    fields.push_back(patch.where == PatchPlace::kAnywhere
                         ? DrawPatchField(heights.nodes, heights.spacing_m, own)
                         : Grid(0, 0.0));
  }
  if (params.ripples.amplitude_m > 0.0)
    AddRipples(heights, params.ripples,
               RipplePresence(params, fields, heights, Rng(seed, episode, Stream::kRipples)));
  const std::vector<Rock> rocks =
      DrawRocks(params.rocks, heights.edge_m(), Rng(seed, episode, Stream::kRocks));
  Grid other = heights;
  AddRocks(other, rocks);
  AddRoughness(heights, params.roughness, other, Rng(seed, episode, Stream::kTerrain));

  std::vector<Cover> covers;
  for (std::size_t i = 0; i < params.patches.size(); ++i) {
    const PatchParams& patch = params.patches[i];
    if (patch.where == PatchPlace::kHollows) fields[i] = CalcHollows(heights);
    double uncovered = 1.0;  // by the patches that come on top
    for (std::size_t j = i + 1; j < params.patches.size(); ++j)
      uncovered *= 1.0 - params.patches[j].fraction;
    const double laid = uncovered > 0.0 ? std::min(1.0, patch.fraction / uncovered) : 0.0;
    LayOver(covers, patch, CoverHighest(fields[i], laid, kBlend_m));
  }
  if (!rocks.empty()) {
    const Material rock{"rock", params.rocks.friction, params.rocks.stiffness_N_per_m3, 0.5, 0.0};
    LayOver(covers, rock, SoftenEdges(AddRocks(heights, rocks)));
  }

  for (double& z : heights.values) z *= params.roughness_scale;
  const std::size_t cut_nodes = LimitSlope(heights, params.max_slope_rad);
  const Vec2 uphill = std::tan(params.slope_rad) *
                      Vec2(std::cos(params.slope_azimuth_rad), std::sin(params.slope_azimuth_rad));
  for (int row = 0; row < heights.nodes; ++row) {
    for (int column = 0; column < heights.nodes; ++column)
      heights.at(column, row) += uphill.dot(heights.Position(column, row));
  }
  return {Heightfield(heights.nodes, heights.spacing_m, std::move(heights.values), params.substrate,
                      std::move(covers)),
          cut_nodes, std::move(remark)};
}

TerrainStatistics MeasureTerrain(const Heightfield& ground, const TerrainParams& params) {
  const Grid heights = HeightsOf(ground);
  const Vec2 plane = FitPlane(heights);
  TerrainStatistics stats;
  const double dx = heights.spacing_m;
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const auto deviation = [&](double lag_m) {
    const bool fits = lag_m >= 0.999 * dx && lag_m <= 0.25 * heights.edge_m();
    return fits ? CalcDeviation(heights, lag_m, plane) : kUnknown;
  };
  stats.nu_10cm_m = deviation(0.1);
  stats.nu_25cm_m = deviation(0.25);
  stats.nu_1m_m = deviation(1.0);
  const double last_m = std::max(10.0 * dx, params.roughness.max_wavelength_m / 10.0);
  const double first_m = std::clamp(params.roughness.break_wavelength_m, 5.0 * dx, 0.5 * last_m);
  const bool rough =
      heights.edge_m() >= 4.0 * last_m && CalcDeviation(heights, first_m, plane) > 0.0;
  stats.hurst = rough ? FitExponent(heights, first_m, last_m, plane) : kUnknown;
  MeasureSlopes(heights, stats);

  stats.materials.push_back({ground.substrate().name, 1.0});
  for (const Cover& cover : ground.covers()) {
    double sum = 0.0;
    for (const std::uint8_t share : cover.share) sum += share;
    const double fraction = sum / (kWhole * static_cast<double>(cover.share.size()));
    stats.materials.push_back({cover.material.name, fraction});
    stats.materials.front().fraction -= fraction;
  }
  return stats;
}

std::vector<Deviation> MeasureDeviogram(const Heightfield& ground, const TerrainParams& params) {
  const Grid heights = HeightsOf(ground);
  const Vec2 plane = FitPlane(heights);
  std::vector<Deviation> out;
  constexpr double kRatio = 1.25;
  const double longest_m = 0.25 * heights.edge_m();
  for (double lag_m = heights.spacing_m; lag_m < longest_m;
       lag_m = std::max(lag_m + heights.spacing_m, kRatio * lag_m)) {
    const double whole_m = std::round(lag_m / heights.spacing_m) * heights.spacing_m;
    out.push_back({whole_m, CalcDeviation(heights, whole_m, plane),
                   params.roughness_scale * TargetDeviation(params.roughness, whole_m)});
  }
  return out;
}

std::string GroundId(const TerrainParams& params, std::uint64_t seed) {
  core::Hash64 hash;
  hash.Add(core::EmitYaml(core::WriteConfig(params)));
  hash.Add(fmt::format("{}", seed));
  const std::filesystem::path& heightmap = params.heightmap.file;
  if (!heightmap.empty()) hash.Add(fmt::format(" {}", core::HashFile(heightmap).value_or(0)));
  return fmt::format("{:016x}", hash.value());
}

}  // namespace scoria::terrains
