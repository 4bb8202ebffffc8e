// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/field/foothold_roughness.h"

namespace scoria::app {

/// Lags at which footholds and presets are compared: a step, and what the trunk spans.
constexpr double kShortLag_m = 0.25, kLongLag_m = 1.0;

/// A preset of the ground beside footholds.
struct TerrainPreset {
  std::filesystem::path file;
  int features = 0;  // beside one roughness on one material
  /// Of the same footholds on its ground: the pattern of their stretches laid down at random.
  double nu_short_m = 0.0, nu_long_m = 0.0;
  double scale = 1.0;     // of its roughness, with which it is nearest to the footholds
  double distance = 0.0;  // then: log ratios, root of the sum of squares, and the scale's cost
};

/// Presets by their distance from the footholds, the nearest first; but of those that are about as
/// near, the plainest first. None if the footholds are too few.
/// Errors: core::ConfigError for a preset.
[[nodiscard]] std::vector<TerrainPreset> NearestPresets(
    const std::filesystem::path& folder, const analysis::FootholdRoughness& footholds);

}  // namespace scoria::app
