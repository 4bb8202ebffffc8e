// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/inspection.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "analysis/terrain/terrain_view.h"
#include "app/inspect/derived_defaults.h"
#include "app/inspect/log_info.h"
#include "app/inspect/verdict.h"
#include "app/run/robot_warnings.h"
#include "app/scenario/config_kinds.h"
#include "app/scenario/scenario.h"
#include "controller/stand_up.h"
#include "core/config/scale.h"
#include "core/files.h"
#include "core/math/angles.h"
#include "core/robot/normalise.h"
#include "core/robot/whole_body.h"
#include "core/robot_files/inspect.h"
#include "core/robot_files/load.h"
#include "core/robot_files/shape_size.h"
#include "core/text.h"
#include "logs/format/open_log.h"
#include "logs/mapping/any_rows.h"
#include "logs/mapping/choose_mapping.h"
#include "logs/mapping/draft_mapping.h"
#include "logs/survey.h"
#include "terrains/generator.h"

namespace scoria::app {
namespace {

std::string KneesOf(const core::LegDescription& leg) {
  return fmt::format("{}{}", core::KneeWay(leg) < 0.0 ? "back" : "forward",
                     core::BendsEitherWay(leg) ? " (their limits allow both ways)" : "");
}

void PrintRobot(const core::RobotDescription& robot) {
  fmt::print("{}: {:.3f} kg, {} foot sensors\n", robot.config.name, robot.total_mass_kg(),
             robot.config.has_foot_sensors ? "with" : "no");
  const core::Similarity& size = robot.similarity;
  if (!size.IsReference())
    fmt::print(
        "defaults: the Go2's at {:.3f} times its mass, {:.3f} times its legs; --defaults lists "
        "them\n",
        size.mass, size.length);
  fmt::print("{:24} {:>8} {:>24} {:>34}\n", "body", "mass kg", "COM x y z m",
             "inertia about it xx yy zz kg m^2");
  for (int i = 0; i < core::kNumBodies; ++i) {
    const core::Body& b = robot.body(i);
    fmt::print("{:24} {:8.3f} {:8.4f}{:8.4f}{:8.4f}   {:10.3g} {:10.3g} {:10.3g}\n", b.name,
               b.mass_kg, b.p_OC.x(), b.p_OC.y(), b.p_OC.z(), b.I_C(0, 0), b.I_C(1, 1),
               b.I_C(2, 2));
  }
  fmt::print("{:24} {:>18} {:>8} {:>8} {:>20}\n", "joint", "limits rad", "Nm", "rad/s",
             "URDF sign and zero");
  for (const Leg leg : kLegs) {
    for (const core::JointDescription& j : robot.legs[leg].joints) {
      fmt::print("{:24} {:8.3f} {:8.3f}  {:8.2f} {:8.2f} {:12.0f} {:7.3f}\n", j.name, j.lower_rad,
                 j.upper_rad, j.effort_Nm, j.velocity_radps, j.urdf_sign, j.urdf_zero_rad);
    }
  }
  const core::LegDescription& leg = robot.legs[Leg::kFL];
  const core::RobotConfig& c = robot.config;
  fmt::print("thigh {:.4f} m, shank {:.4f} m, foot radius {:.4f} m\n", core::ThighLength(leg),
             core::ShankLength(leg), leg.foot_radius_m);
  fmt::print(
      "walks {:.3f} m high, reaches {:.3f} m from the hip, feet at x {:.3f} and {:.3f}, y "
      "+-{:.3f} and {:.3f} m\n",
      c.nominal_height_m, c.max_leg_length_m, c.stance_front_m.x(), c.stance_hind_m.x(),
      c.stance_front_m.y(), c.stance_hind_m.y());
  fmt::print("knees bend {} in front, {} behind\n", KneesOf(robot.legs[Leg::kFL]),
             KneesOf(robot.legs[Leg::kHL]));
  core::WholeBody wb;
  RobotState standing;
  standing.q = controller::StandingPose(robot, c.nominal_height_m);
  core::WholeBodyModel(robot, 9.81).Calc(standing, wb);
  fmt::print(
      "standing: COM x {:.4f}, y {:.4f}, z {:.4f} m from the base link; inertia about it "
      "{:.3f} {:.3f} {:.3f} kg m^2\n",
      wb.p_WC.x(), wb.p_WC.y(), wb.p_WC.z(), wb.I_C_W(0, 0), wb.I_C_W(1, 1), wb.I_C_W(2, 2));
}

/// Sizes of what collides.
void PrintShapes(const core::RobotDescription& robot) {
  fmt::print("{:24} {:>24}\n", "collides", "edges of its box m");
  for (const core::Shape& shape : robot.collisions) {
    const Vec3 size_m = core::ExtentOf(shape);
    const std::string kind = shape.kind == core::Shape::Kind::kHull
                                 ? fmt::format("convex hull of {} points", shape.hull.size())
                             : shape.kind == core::Shape::Kind::kBox      ? "box"
                             : shape.kind == core::Shape::Kind::kCylinder ? "capsule"
                             : shape.is_foot                              ? "foot"
                                                                          : "sphere";
    fmt::print("{:24} {:8.3f}{:8.3f}{:8.3f}   {}{}\n", shape.link, size_m.x(), size_m.y(),
               size_m.z(), kind,
               shape.mesh.empty() ? "" : fmt::format(", {}", shape.mesh.filename().string()));
  }
}

/// Four digits: enough to judge by, as scenarios get all of them.
std::string ShortNumber(const std::string& text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() ? fmt::format("{:.4g}", value)
                                                                  : text;
}

void PrintDefaults(const core::RobotDescription& robot) {
  fmt::print("{:56} {:>10} {:>10}\n", "default of scenarios", "of go2", "of robot");
  for (const DerivedDefault& value : DerivedDefaults(robot.similarity))
    fmt::print("{:56} {:>10} {:>10}\n", value.key, ShortNumber(value.of_go2),
               ShortNumber(value.of_robot));
}

/// By the defaults of a scenario.
void PrintVerdict(const core::RobotDescription& robot) {
  const std::vector<WalkFinding> findings =
      JudgeRobot(robot, ConditionsOf(core::Scaled(Scenario{}, robot.similarity), robot));
  for (const WalkFinding& finding : findings) {
    fmt::print("{:8} {:7} {}\n", core::EnumName(finding.topic),
               finding.grade == WalkGrade::kMet      ? "ok"
               : finding.grade == WalkGrade::kScarce ? "scarce"
                                                     : "NOT MET",
               finding.text);
  }
  fmt::print("verdict: {}\n", Verdict(findings));
}

struct InfoOptions {
  std::string file;
  std::vector<std::filesystem::path> msg_paths;
  std::optional<std::string> mapping;
  std::filesystem::path draft_mapping;
  bool json = false, defaults = false;

  [[nodiscard]] bool AsksOfALog() const {
    return json || !msg_paths.empty() || mapping || !draft_mapping.empty();
  }
};

void PrintRobotInfo(const InfoOptions& options) {
  const core::RobotDescription robot = ReadScaledRobot(LoadKind("robot", options.file, {}));
  PrintRobot(robot);
  PrintShapes(robot);
  if (options.defaults) PrintDefaults(robot);
  std::vector<std::string> warnings = core::FindSuspicions(robot);
  for (std::string& warning : core::FindModelWarnings(robot))
    warnings.push_back(std::move(warning));
  for (const std::string& warning : warnings) fmt::print("warning: {}\n", warning);
  PrintVerdict(robot);
}

/// How a log becomes rows, in words.
std::string RowsText(logs::LogSource& log, const logs::TypeResolver& resolver,
                     const InfoOptions& options) {
  if (!options.mapping && logs::HasOwnRows(log.contents())) return "canonical signals: its own\n";
  try {
    const logs::Mapping mapping = logs::MappingFor(log.contents(), options.mapping);
    return logs::DescribeReport(
        logs::ForEachMappedRow(log, mapping, resolver, [](const logs::Row&) {}));
  } catch (const logs::MappingChoiceError& e) {
    return fmt::format("{}\n", e.what());
  }
}

void WriteDraft(const std::filesystem::path& file, logs::LogSource& log,
                const logs::TypeResolver& resolver) {
  if (std::filesystem::exists(file))
    throw std::runtime_error(fmt::format("{}: exists; name a file that does not", file.string()));
  core::WriteText(file, logs::DraftMapping(log, resolver));
  fmt::print("{}: a draft; read its comments, then info {} --mapping {}\n", file.string(),
             log.contents().path.string(), file.string());
}

void PrintLogInfo(const InfoOptions& options) {
  const logs::TypeResolver resolver(options.msg_paths);
  const std::unique_ptr<logs::LogSource> log = logs::OpenLog(options.file);
  if (!options.draft_mapping.empty()) return WriteDraft(options.draft_mapping, *log, resolver);
  const logs::LogSurvey survey = logs::SurveyLog(*log, resolver);
  if (options.json) {
    fmt::print("{}", analysis::JsonText(LogInfoJson(*log, survey)));
  } else {
    fmt::print("{}\n{}", LogInfoText(*log, survey), RowsText(*log, resolver, options));
  }
}

void AddInfo(CLI::App& app) {
  auto o = std::make_shared<InfoOptions>();
  CLI::App* info = app.add_subcommand(
      "info", "print what a log or a robot's files hold, and what is wrong with them");
  info->add_option("file", o->file, "a log (a file, or the folder of a bag), or a robot YAML")
      ->required();
  info->add_option("--msg-path", o->msg_paths,
                   "folder of .msg or .idl files that define types of a log; may be repeated");
  info->add_option("--mapping", o->mapping,
                   "mapping file, or name of a shipped one (default: the one that fits a log)");
  info->add_option("--draft-mapping", o->draft_mapping, "write a draft of a mapping for a log");
  info->add_flag("--json", o->json, "print what a log holds as JSON");
  info->add_flag("--defaults", o->defaults, "list the defaults that go with a robot's size");
  info->callback([o] {
    if (IsTakenForLog(o->file)) {
      if (o->defaults)
        throw std::runtime_error(fmt::format("{}: is no robot; --defaults is for robots", o->file));
      return PrintLogInfo(*o);
    }
    if (o->AsksOfALog())
      throw std::runtime_error(fmt::format(
          "{}: is no log; --json, --msg-path, --mapping and --draft-mapping are for logs",
          o->file));
    PrintRobotInfo(*o);
  });
}

/// The terrain of a file, or of a preset by its name: terrains/NAME.yaml here or beside the
/// program's build folder.
terrains::TerrainParams LoadTerrain(const std::string& name, const std::vector<std::string>& set) {
  namespace fs = std::filesystem;
  fs::path file = name;
  std::vector<std::string> presets;
  const fs::path source =
      fs::read_symlink("/proc/self/exe").parent_path().parent_path().parent_path().parent_path();
  for (const fs::path& folder : {fs::path("terrains"), source / "terrains"}) {
    if (fs::exists(file)) break;
    if (fs::exists(folder / (name + ".yaml"))) file = folder / (name + ".yaml");
    if (!fs::is_directory(folder) || !presets.empty()) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".yaml") presets.push_back(entry.path().stem().string());
    }
  }
  if (!fs::exists(file)) {
    std::sort(presets.begin(), presets.end());
    throw core::ConfigError({name, 0, 0}, "terrain",
                            fmt::format("is neither a file nor a preset; choices: {}{}",
                                        fmt::join(presets, ", "), core::DidYouMean(name, presets)));
  }
  return core::ReadConfig<terrains::TerrainParams>(LoadKind("terrain", file, set));
}

void PrintTerrain(const terrains::TerrainParams& params, const terrains::Terrain& terrain,
                  const terrains::TerrainStatistics& s, std::size_t rocks) {
  const terrains::Heightfield& ground = terrain.ground;
  const double spacing_m = ground.resolution_m(), edge_m = ground.nodes() * spacing_m;
  const terrains::RoughnessParams& asked = params.roughness;
  fmt::print("{}: {:.1f} m of ground, {:.3f} m grid\n", params.name, edge_m, spacing_m);
  const auto wanted = [&](double value) {
    return asked.nu_1m_m > 0.0 ? fmt::format(" (asked {:.4f})", value) : "";
  };
  fmt::print("  RMS height difference  {:.4f} m at 0.1 m, {:.4f} m at 0.25 m, {:.4f} m at 1 m{}\n",
             s.nu_10cm_m, s.nu_25cm_m, s.nu_1m_m, wanted(params.roughness_scale * asked.nu_1m_m));
  fmt::print("  Hurst exponent         {:.4f}{}\n", s.hurst, wanted(asked.hurst));
  fmt::print("  slope                  {:.1f} deg mean, {:.1f} deg 95 %\n",
             s.slope_mean_rad * core::kDegreesPerRad, s.slope_95_rad * core::kDegreesPerRad);
  if (params.rocks.area_fraction > 0.0) {
    const double expected =
        terrains::RockDensity(params.rocks, params.rocks.min_diameter_m) * edge_m * edge_m;
    fmt::print("  rocks                  {} (expected {:.0f} +- {:.0f})\n", rocks, expected,
               std::sqrt(expected));
  }
  fmt::print("  cut to max_slope_rad   {} of {} nodes\n", terrain.cut_nodes,
             ground.heights_m().size());
  for (const auto& [name, fraction] : s.materials)
    fmt::print("  {:22} {:.1f} %\n", name, 100.0 * fraction);
  for (const std::string& remark : terrains::HeightmapRemarks(terrain, params))
    fmt::print("warning: {}\n", remark);
}

void AddTerrain(CLI::App& app) {
  struct Options {
    std::string name, out;
    std::vector<std::string> set;
    std::uint64_t seed = 1;
    bool json = false, no_pictures = false;
  };
  auto o = std::make_shared<Options>();
  CLI::App* terrain =
      app.add_subcommand("terrain", "make a ground, measure it, and draw its relief and deviogram");
  terrain->add_option("terrain", o->name, "name of a preset, or a terrain YAML")->required();
  terrain->add_option("--seed", o->seed, "master seed (default 1)");
  terrain->add_option("--set", o->set, "override a key, as roughness_scale=2");
  terrain->add_option("--out", o->out, "folder for the pictures (default out/terrain/NAME)");
  terrain->add_flag("--json", o->json, "print the numbers as JSON instead of a summary");
  terrain->add_flag("--no-pictures", o->no_pictures, "print only, write no files");
  terrain->callback([o] {
    const terrains::TerrainParams params = LoadTerrain(o->name, o->set);
    const terrains::Terrain made = terrains::MakeTerrain(params, o->seed, 0);
    const terrains::Heightfield& ground = made.ground;
    const terrains::TerrainStatistics statistics = terrains::MeasureTerrain(ground, params);
    const std::filesystem::path folder =
        o->out.empty() ? std::filesystem::path("out/terrain") / core::FileNameOf(params.name)
                       : std::filesystem::path(o->out);
    if (!o->no_pictures) analysis::WriteTerrainView(ground, params, statistics, folder);
    if (o->json) {
      nlohmann::json json = analysis::TerrainJson(ground, params, statistics);
      json["cut_nodes"] = made.cut_nodes;
      fmt::print("{}", analysis::JsonText(json));
      return;
    }
    const double edge_m = ground.nodes() * ground.resolution_m();
    const std::size_t rocks =
        terrains::DrawRocks(params.rocks, edge_m, core::Rng(o->seed, 0, core::Stream::kRocks))
            .size();
    PrintTerrain(params, made, statistics, rocks);
    if (!o->no_pictures) {
      fmt::print("  files                  {}/relief.png, deviogram.png, terrain.json\n",
                 folder.string());
    }
  });
}

}  // namespace

void AddInspection(CLI::App& app) {
  AddInfo(app);
  AddTerrain(app);
}

}  // namespace scoria::app
