// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/cli/commands.h"
#include "app/cli/note.h"
#include "app/cli/print_estimation.h"
#include "app/rerun/replay.h"
#include "app/rerun/replay_text.h"
#include "app/rerun/replay_variants.h"
#include "core/files.h"
#include "logs/format/open_log.h"

namespace scoria::app {
namespace {

struct ReplayArguments {
  LogInputOptions input;
  std::vector<std::string> set, variants;
  ReplayOutputs outputs;
  std::filesystem::path json;
  int workers = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

/// The controller of the log's own walk, step by step.
int ReplayController(const ReplayArguments& o) {
  const ReplayResult result = ReplayLog(o.input.log, o.set);
  if (!result.file_problem.empty()) fmt::print("{}\n", result.file_problem);
  fmt::print("replayed {} steps: {}\n", result.steps,
             result.identical
                 ? fmt::format("all {} estimates have the bits of the log", result.rows)
                 : fmt::format("estimates differ from {:.3f} s on", result.first_difference_s));
  PrintEstimation("logged", result.logged, result.groups);
  PrintEstimation("replayed", result.replayed, result.groups);
  return !result.identical && o.set.empty() ? kFailed : kOk;
}

/// Where none are asked for: the estimators that there are.
std::vector<Variant> VariantsOf(const ReplayArguments& o) {
  std::vector<Variant> variants;
  for (const std::string& text : o.variants) variants.push_back(ParseVariant(text));
  if (!variants.empty()) return variants;
  for (const char* type : {"inekf", "linear_kf", "leg_odometry"})
    variants.push_back({type, {fmt::format("controller.estimator.type={}", type)}});
  return variants;
}

int ReplayRows(const ReplayArguments& o) {
  const ReplayReport report = ReplayVariants(o.input, VariantsOf(o), o.outputs, o.workers);
  if (!report.inputs.problem.empty()) Note(report.inputs.problem);
  fmt::print("{}", DescribeReplay(report));
  if (!o.json.empty()) core::WriteText(o.json, ReplayJson(report).dump(2) + "\n");
  for (const std::filesystem::path& file : report.files) fmt::print("{}\n", file.string());
  return kOk;
}

}  // namespace

void AddReplay(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<ReplayArguments>();
  CLI::App* replay = app.add_subcommand(
      "replay", "estimate again on what a log's sensors said, as it was or with other variants");
  replay->add_option("log", o->input.log, "a log: a file, or the folder of a bag")->required();
  CLI::Option* set = replay->add_option(
      "--set", o->set,
      "of a log that scoria wrote with log.keep=full: its controller step by step, with a key "
      "overridden, as controller.estimator.type=linear_kf");
  CLI::Option* variant = replay->add_option(
      "--variant", o->variants,
      "NAME=key=value,key=value; may be repeated: estimate on the log's samples, all side by side");
  variant->excludes(set);
  replay->add_option("--robot", o->input.robot, "the robot's YAML (default: the log's own)");
  replay->add_option("--mapping", o->input.rows.mapping,
                     "mapping file, or name of a shipped one (default: the one that fits)");
  replay->add_option("--msg-path", o->input.rows.msg_paths,
                     "folder of .msg or .idl files that define types; may be repeated");
  replay->add_option("-o,--out", o->outputs.log, "MCAP log of all estimates, by name");
  replay->add_option("--tum", o->outputs.tum, "folder of trajectories in TUM's format (evo)");
  replay->add_option("--json", o->json, "scores as JSON");
  replay->add_option("-j,--workers", o->workers, "threads")->check(CLI::Range(1, 1024));
  replay->add_flag("--force", o->outputs.force, "overwrite files that are there");
  replay->callback([o, variant, &exit_code] {
    const bool own = !o->input.rows.mapping && !o->input.robot &&
                     logs::HasOwnRows(logs::OpenLog(o->input.log)->contents());
    const bool asks_for_files = !o->outputs.log.empty() || !o->outputs.tum.empty();
    const bool by_controller =
        !o->set.empty() || (own && variant->empty() && !asks_for_files && o->json.empty());
    exit_code = by_controller ? ReplayController(*o) : ReplayRows(*o);
  });
}

}  // namespace scoria::app
