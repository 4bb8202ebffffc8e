// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/draft_scenario.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "app/rerun/nearest_preset.h"
#include "app/rerun/read_friction.h"
#include "app/rerun/walk_summary.h"
#include "core/config/archive.h"
#include "core/files.h"
#include "logs/format/temporary_folder.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// Share of its apex that a swinging foot reaches: 0.90 to 0.91 with apexes of 0.06, 0.10 and 0.14
/// m of a Go2 with `ags` on self-affine ground, 0.94 with `sgs`.
constexpr double kReached = 0.9;

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

std::string DraftRobot(const fs::path& out, const LogInputs& inputs) {
  if (!inputs.robot_file.empty())
    return fmt::format("robot: {{base: {}}}\n", From(out, inputs.robot_file));
  return "robot:  # as the log holds it\n" +
         Indented(core::EmitYaml(core::WriteConfig(inputs.robot.config)));
}

/// The friction as it is read by walks of a draft that lacks it.
struct Friction {
  std::optional<double> slip_m;  // of the log
  std::vector<SlipOnFriction> walked;
  std::optional<double> value;
  std::string problem;  // why there is none, in words
};

std::string DraftFriction(const Friction& friction) {
  if (friction.walked.empty())
    return fmt::format("# Not known: friction, which is the preset's{}{}.\n",
                       friction.problem.empty() ? "" : ": ", friction.problem);
  std::string text = fmt::format(
      "# Friction by the slip that 95 % of the stances stay below: {:.1f} mm. In walks of this "
      "draft it is\n#",
      1e3 * *friction.slip_m);
  for (const SlipOnFriction& w : friction.walked)
    text += fmt::format("{} {:.1f} mm on {:.2f}", &w == friction.walked.data() ? "" : ",",
                        1e3 * w.slip_m, w.friction);
  return text + (friction.value
                     ? ".\n"
                     : ".\n# That does not tell frictions apart: this is the preset's.\n");
}

std::string DraftTerrain(const fs::path& out, const std::vector<TerrainPreset>& presets,
                         const WalkSummary& walk, const fs::path& terrains,
                         const Friction& friction) {
  const std::string substrate =
      friction.value ? fmt::format(", substrate: {{friction: {:.2f}}}", *friction.value) : "";
  if (presets.empty())
    return "# Not known: the footholds are too few to tell the ground. This one is level.\n" +
           DraftFriction(friction) +
           fmt::format("terrain: {{base: {}{}}}\n", From(out, terrains / "flat.yaml"), substrate);
  std::string text = fmt::format(
      "# A guess: nearest of {} presets to the footholds, the plainest of those that are equally "
      "near. Footholds differ in\n# height by {:.0f} mm at {} m and {:.0f} mm at {} m;",
      presets.size(), 1e3 * *walk.roughness.Nu_m(kShortLag_m), kShortLag_m,
      1e3 * *walk.roughness.Nu_m(kLongLag_m), kLongLag_m);
  for (std::size_t i = 0; i < std::min<std::size_t>(3, presets.size()); ++i)
    text += fmt::format(" {}: {:.0f} and {:.0f} mm{}", presets[i].file.stem().string(),
                        1e3 * presets[i].nu_short_m, 1e3 * presets[i].nu_long_m,
                        i + 1 < std::min<std::size_t>(3, presets.size()) ? "," : ".");
  return text + "\n# Not known: slope, rocks and stiffness, which are the preset's.\n" +
         DraftFriction(friction) +
         fmt::format("terrain: {{base: {}, roughness_scale: {:.2f}{}}}\n",
                     From(out, presets.front().file), presets.front().scale, substrate);
}

std::string DraftOperator(const WalkSummary& walk) {
  std::string text =
      walk.commanded ? "# By the log's commands, means over 0.25 s.\n"
                     : "# The log holds no commands: these are the velocities that were walked.\n";
  text +=
      "# Headings are those that were walked: the ground of a twin turns it otherwise.\n"
      "operator:\n  type: velocity\n";
  text += walk.velocities.empty() ? "  steps: []\n" : "  steps:\n";
  for (const HeldVelocity& v : walk.velocities)
    text += fmt::format(
        "    - {{at_s: {:.2f}, v_x_mps: {:.4f}, v_y_mps: {:.4f}, w_z_radps: {:.4f}, heading_rad: "
        "{:.3f}}}\n",
        v.at_s, v.v_x_mps, v.v_y_mps, v.w_z_radps, v.heading_rad);
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

std::string DraftController(const fs::path& out, const DraftScenarioOptions& options,
                            const LogInputs& inputs, const WalkSummary& walk) {
  std::string text = "# Not known: gains and weights, which are the defaults.\ncontroller:\n";
  const fs::path base = options.controllers / (inputs.robot.config.name + ".yaml");
  if (fs::exists(base)) text += fmt::format("  base: {}\n", From(out, base));
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

/// What a draft is made of.
struct Findings {
  LogInputs inputs;
  WalkSummary walk;
  std::vector<TerrainPreset> presets;
  Friction friction = {};
};

std::string DraftText(const DraftScenarioOptions& options, const Findings& found,
                      const fs::path& out) {
  const WalkSummary& walk = found.walk;
  std::string text =
      fmt::format("# Drafted from {}; comments say what is measured and what is not known.\n",
                  options.input.log.filename().string());
  text += fmt::format("name: twin_of_{}\n", options.input.log.stem().string());
  text += DraftRobot(out, found.inputs) +
          DraftTerrain(out, found.presets, walk, options.terrains, found.friction);
  constexpr double kLongestBefore_s = 3.0;  // a twin does not lie about first
  text += fmt::format("duration_s: {:.1f}\n",
                      std::max(0.1, walk.duration_s + std::min(walk.before_s, kLongestBefore_s)));
  return text + DraftOperator(walk) + DraftController(out, options, found.inputs, walk) +
         DraftPayload(found.inputs, walk);
}

/// By walks of the draft without it.
Friction FindFriction(const DraftScenarioOptions& options, const Findings& found) {
  AnalyzeOptions how;
  if (options.input.robot) how.robot = options.input.robot->string();
  how.rows = options.input.rows;
  Friction friction;
  try {
    friction.slip_m = SlipOf(options.input.log, how);
    if (!friction.slip_m) {
      friction.problem = "the log does not tell how far its feet slip";
      return friction;
    }
    const logs::TemporaryFolder folder;
    const fs::path draft = folder.path() / "draft.yaml";
    core::WriteText(draft, DraftText(options, found, draft));
    friction.walked = WalkFrictions(draft);
    friction.value = ReadFriction(friction.walked, *friction.slip_m);
    if (friction.walked.empty()) friction.problem = "the draft does not walk";
  } catch (const std::runtime_error& e) {  // the draft is worth having all the same
    const std::string what = e.what();
    friction.problem = what.substr(0, what.find('\n'));
  }
  return friction;
}

}  // namespace

std::string DraftScenario(const DraftScenarioOptions& options) {
  Findings found{SurveyInputs(options.input), {}, {}};
  found.walk = SummariseWalk(options.input, found.inputs);
  found.presets = NearestPresets(options.terrains, found.walk.roughness);
  if (options.walks) found.friction = FindFriction(options, found);
  return DraftText(options, found, options.out);
}

}  // namespace scoria::app
