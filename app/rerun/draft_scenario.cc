// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/draft_scenario.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "app/rerun/walk_summary.h"
#include "app/scenario/config_kinds.h"
#include "core/config/archive.h"
#include "core/files.h"
#include "terrains/generator.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// Lags at which footholds and presets are compared: a step, and what the trunk spans.
constexpr double kShort_m = 0.25, kLong_m = 1.0;

/// What footholds on level ground differ by, as a Go2's walk tells them.
constexpr double kNoise_m = 0.008;

/// The walked part of a ground is rougher or smoother than the whole: an operator chooses the way.
/// A factor is cheaper than another form, by this share of its logarithm.
constexpr double kLeastScale = 0.4, kMostScale = 2.5, kScaleCost = 0.5;

/// Share of its apex that a swinging foot reaches: 0.90 to 0.91 with apexes of 0.06, 0.10 and 0.14
/// m of a Go2 with `ags` on self-affine ground, 0.94 with `sgs`.
constexpr double kReached = 0.9;

/// Distances that differ by less are equal: over some twenty metres of way the roughness of one
/// ground scatters by more.
constexpr double kIndistinct = 0.15;

/// What a ground has beside one roughness on one material.
int CountFeatures(const terrains::TerrainParams& t) {
  return static_cast<int>(t.patches.size()) + (t.slope_rad != 0.0) + (t.rocks.area_fraction > 0.0) +
         (t.ripples.amplitude_m > 0.0) + (t.gullies.per_20m > 0.0) + (t.craters.per_100m2 > 0.0) +
         (t.ropes.amplitude_m > 0.0) + (t.cells.amplitude_m > 0.0) + !t.heightmap.file.empty();
}

struct Preset {
  fs::path file;
  int features = 0;
  double nu_short_m = 0.0, nu_long_m = 0.0;
  double scale = 1.0;     // with which it is nearest to the footholds
  double distance = 0.0;  // then: log ratios, root of the sum of squares, and the scale's cost
};

/// The scale with which a preset is nearest to footholds.
void Fit(double found_short_m, double found_long_m, Preset& preset) {
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

/// Presets by their distance from the footholds, the nearest first; but of those that are about as
/// near, the plainest first. None if the footholds are too few.
std::vector<Preset> NearestPresets(const fs::path& folder,
                                   const analysis::FootholdRoughness& footholds) {
  const std::optional<double> at_short = footholds.Nu_m(kShort_m),
                              at_long = footholds.Nu_m(kLong_m);
  if (!at_short || !at_long) return {};
  std::vector<Preset> presets;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".yaml") continue;
    const auto params =
        core::ReadConfig<terrains::TerrainParams>(LoadKind("terrain", entry.path(), {}));
    const terrains::TerrainStatistics found =
        terrains::MeasureTerrain(terrains::GenerateTerrain(params, 1, 0), params);
    const auto known = [](double nu_m) { return std::isfinite(nu_m) ? nu_m : 0.0; };
    Preset preset{entry.path(), CountFeatures(params), known(found.nu_25cm_m),
                  known(found.nu_1m_m)};
    Fit(*at_short, *at_long, preset);
    presets.push_back(preset);
  }
  std::ranges::sort(presets, {}, &Preset::distance);
  const auto as_near = std::ranges::find_if(presets, [&](const Preset& preset) {
    return preset.distance > presets.front().distance + kIndistinct;
  });
  std::ranges::stable_sort(presets.begin(), as_near, {}, &Preset::features);
  return presets;
}

/// A path as the drafted file names it.
std::string From(const fs::path& out, const fs::path& file) {
  const fs::path folder = fs::absolute(out).parent_path();
  return fs::absolute(file).lexically_relative(folder).string();
}

std::string Indented(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    out += "  " + text.substr(begin, end - begin) + '\n';
    begin = end + 1;
  }
  return out;
}

std::string DraftRobot(const DraftScenarioOptions& options, const LogInputs& inputs) {
  if (!inputs.robot_file.empty())
    return fmt::format("robot: {{base: {}}}\n", From(options.out, inputs.robot_file));
  return "robot:  # as the log holds it\n" +
         Indented(core::EmitYaml(core::WriteConfig(inputs.robot.config)));
}

std::string DraftTerrain(const DraftScenarioOptions& options, const WalkSummary& walk) {
  const std::vector<Preset> presets = NearestPresets(options.terrains, walk.roughness);
  if (presets.empty())
    return "# Not known: the footholds are too few to tell the ground. This one is level.\n" +
           fmt::format("terrain: {{base: {}}}\n",
                       From(options.out, options.terrains / "flat.yaml"));
  std::string text = fmt::format(
      "# A guess: nearest of {} presets to the footholds, the plainest of those that are equally "
      "near. Footholds differ in\n# height by {:.0f} mm at {} m and {:.0f} mm at {} m;",
      presets.size(), 1e3 * *walk.roughness.Nu_m(kShort_m), kShort_m,
      1e3 * *walk.roughness.Nu_m(kLong_m), kLong_m);
  for (std::size_t i = 0; i < std::min<std::size_t>(3, presets.size()); ++i)
    text += fmt::format(" {}: {:.0f} and {:.0f} mm{}", presets[i].file.stem().string(),
                        1e3 * presets[i].nu_short_m, 1e3 * presets[i].nu_long_m,
                        i + 1 < std::min<std::size_t>(3, presets.size()) ? "," : ".");
  return text + "\n# Not known: slope, rocks, friction and stiffness, which are the preset's.\n" +
         fmt::format("terrain: {{base: {}, roughness_scale: {:.2f}}}\n",
                     From(options.out, presets.front().file), presets.front().scale);
}

std::string DraftOperator(const WalkSummary& walk) {
  std::string text =
      walk.commanded ? "# By the log's commands, means over 0.25 s.\n"
                     : "# The log holds no commands: these are the velocities that were walked.\n";
  text += "operator:\n  type: velocity\n  steps:\n";
  for (const HeldVelocity& v : walk.velocities)
    text +=
        fmt::format("    - {{at_s: {:.2f}, v_x_mps: {:.4f}, v_y_mps: {:.4f}, w_z_radps: {:.4f}}}\n",
                    v.at_s, v.v_x_mps, v.v_y_mps, v.w_z_radps);
  return text;
}

/// Timing that varies with the speed is that of an adaptive sequencer.
std::string DraftGait(const WalkSummary& walk) {
  if (!walk.gait) return "  # Not known: the log holds no gait plan.\n  gait: {type: ags}\n";
  constexpr double kConstant = 0.02;
  const GaitSummary& gait = *walk.gait;
  if (gait.period_share > kConstant || gait.duty_range > kConstant)
    return fmt::format(
        "  # Period and duty vary ({:.2f} s by {:.0f} %, {:.2f}): an adaptive sequencer.\n"
        "  gait: {{type: ags}}\n",
        gait.period_s, 100.0 * gait.period_share, gait.duty);
  return fmt::format(
      "  # Period and duty are constant: a simple sequencer.\n"
      "  gait: {{type: sgs, period_s: {:.3f}, duty: {:.3f}, offset: [{:.2f}, {:.2f}, {:.2f}, "
      "{:.2f}]}}\n",
      gait.period_s, gait.duty, gait.offset[0], gait.offset[1], gait.offset[2], gait.offset[3]);
}

std::string DraftController(const DraftScenarioOptions& options, const LogInputs& inputs,
                            const WalkSummary& walk) {
  std::string text = "# Not known: gains and weights, which are the defaults.\ncontroller:\n";
  const fs::path base = options.controllers / (inputs.robot.config.name + ".yaml");
  if (fs::exists(base)) text += fmt::format("  base: {}\n", From(options.out, base));
  text += DraftGait(walk);
  if (walk.swing_lift_m)
    text += fmt::format(
        "  swing: {{apex_m: {:.3f}}}  # feet lift by {:.3f} m, the median: a tenth short of it\n",
        std::clamp(*walk.swing_lift_m / kReached, 0.0, 0.5), *walk.swing_lift_m);
  return text;
}

std::string DraftPayload(const LogInputs& inputs, const WalkSummary& walk) {
  if (!walk.mass_kg) return "# Not known: a payload; the log holds no torques to weigh it.\n";
  return fmt::format(
      "# By the torques, untared, the robot weighs {:.2f} kg; its model {:.2f} kg. A payload is "
      "not "
      "drafted: torques misread.\n# payloads: [{{at_s: 0, action: add, body: {{name: load, "
      "mass_kg: "
      "{:.2f}}}}}]\n",
      *walk.mass_kg, inputs.robot.total_mass_kg(),
      std::max(0.0, *walk.mass_kg - inputs.robot.total_mass_kg()));
}

}  // namespace

std::string DraftScenario(const DraftScenarioOptions& options) {
  const LogInputs inputs = SurveyInputs(options.input);
  std::vector<std::string> set;
  if (inputs.torques)
    set = {"controller.adaptation.type=kf_plus", "controller.adaptation.tare.enabled=false"};
  if (!inputs.accelerometer) set.emplace_back("controller.estimator.type=leg_odometry");
  const WalkSummary walk = SummariseWalk(options.input, inputs, SetUpVariant(inputs, set).params);
  std::string text =
      fmt::format("# Drafted from {}; comments say what is measured and what is not known.\n",
                  options.input.log.filename().string());
  text += fmt::format("name: twin_of_{}\n", options.input.log.stem().string());
  text += DraftRobot(options, inputs) + DraftTerrain(options, walk);
  text += fmt::format("duration_s: {:.1f}\n", std::max(0.1, walk.duration_s));
  return text + DraftOperator(walk) + DraftController(options, inputs, walk) +
         DraftPayload(inputs, walk);
}

}  // namespace scoria::app
