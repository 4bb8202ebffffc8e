// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/nearest_preset.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "app/scenario/config_kinds.h"
#include "core/config/archive.h"
#include "core/rng.h"
#include "terrains/generator.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// What footholds on level ground differ by, as a Go2's walk tells them.
constexpr double kNoise_m = 0.008;

/// The walked part of a ground is rougher or smoother than the whole: an operator chooses the way.
/// A factor is cheaper than another form, by this share of its logarithm.
constexpr double kLeastScale = 0.4, kMostScale = 2.5, kScaleCost = 0.5;

/// Distances that differ by less are equal: so much the roughness of one ground scatters over
/// twenty metres of way, and over a shorter way by more.
double Indistinct(std::size_t stretches) {
  constexpr double kOfTen = 0.15;
  return kOfTen * std::sqrt(10.0 / static_cast<double>(stretches));
}

int CountFeatures(const terrains::TerrainParams& t) {
  return static_cast<int>(t.patches.size()) + (t.slope_rad != 0.0) + (t.rocks.area_fraction > 0.0) +
         (t.ripples.amplitude_m > 0.0) + (t.gullies.per_20m > 0.0) + (t.craters.per_100m2 > 0.0) +
         (t.ropes.amplitude_m > 0.0) + (t.cells.amplitude_m > 0.0) + !t.heightmap.file.empty();
}

/// The stretches of a walk, again and again at random places and headings of another ground.
analysis::FootholdRoughness LaidOn(const terrains::Heightfield& ground,
                                   const analysis::FootholdRoughness& footholds) {
  constexpr std::size_t kStretches = 400;
  const std::vector<std::span<const Vec3>> stretches = footholds.Stretches();
  const double inside_m =
      std::max(0.0, ground.half_size_m() - analysis::FootholdRoughness::kStretch_m);
  core::Rng rng(1, 0, core::Stream::kTerrain);
  analysis::FootholdRoughness laid;
  for (std::size_t k = 0; k < kStretches; ++k) {
    const std::span<const Vec3> stretch = stretches[k % stretches.size()];
    const Vec2 place(rng.NextUniform(-inside_m, inside_m), rng.NextUniform(-inside_m, inside_m));
    const Eigen::Rotation2Dd turn(rng.NextUniform(0.0, 2.0 * std::numbers::pi));
    for (const Vec3& p : stretch) {
      const Vec2 xy = place + turn * Vec2((p - stretch.front()).head<2>());
      laid.Add({xy.x(), xy.y(), ground.HeightAt(xy.x(), xy.y())});
    }
    laid.Break();
  }
  return laid;
}

/// The scale with which a preset is nearest to footholds.
void Fit(double found_short_m, double found_long_m, TerrainPreset& preset) {
  const auto ratio = [](double found_m, double preset_m) {
    return std::log(std::max(found_m, kNoise_m) / std::hypot(preset_m, kNoise_m));
  };
  const double at_short = ratio(found_short_m, preset.nu_short_m),
               at_long = ratio(found_long_m, preset.nu_long_m);
  const bool is_level = std::max(preset.nu_short_m, preset.nu_long_m) < kNoise_m;
  const double log_scale = is_level ? 0.0
                                    : std::clamp(0.5 * (at_short + at_long), std::log(kLeastScale),
                                                 std::log(kMostScale));
  preset.scale = std::exp(log_scale);
  preset.distance =
      std::hypot(at_short - log_scale, at_long - log_scale) + kScaleCost * std::abs(log_scale);
}

}  // namespace

std::vector<TerrainPreset> NearestPresets(const fs::path& folder,
                                          const analysis::FootholdRoughness& footholds) {
  const std::optional<double> at_short = footholds.Nu_m(kShortLag_m),
                              at_long = footholds.Nu_m(kLongLag_m);
  if (!at_short || !at_long) return {};
  std::vector<TerrainPreset> presets;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    const auto params =
        core::ReadConfig<terrains::TerrainParams>(LoadKind("terrain", entry.path(), {}));
    const analysis::FootholdRoughness laid =
        LaidOn(terrains::GenerateTerrain(params, 1, 0), footholds);
    TerrainPreset preset{entry.path(), CountFeatures(params), laid.Nu_m(kShortLag_m).value_or(0.0),
                         laid.Nu_m(kLongLag_m).value_or(0.0)};
    Fit(*at_short, *at_long, preset);
    presets.push_back(preset);
  }
  std::ranges::sort(presets, {}, &TerrainPreset::distance);
  const double indistinct = Indistinct(footholds.Stretches().size());
  const auto as_near = std::ranges::find_if(presets, [&](const TerrainPreset& preset) {
    return preset.distance > presets.front().distance + indistinct;
  });
  std::ranges::stable_sort(presets.begin(), as_near, {}, &TerrainPreset::features);
  return presets;
}

}  // namespace scoria::app
