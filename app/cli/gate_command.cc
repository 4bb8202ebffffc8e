// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "app/cli/commands.h"
#include "app/cli/interrupts.h"
#include "app/cli/note.h"
#include "app/gate/run_gate.h"
#include "core/files.h"

namespace scoria::app {
namespace {

struct GateArguments {
  std::string file, baseline, baseline_program, twin, walked, out, json;
  std::vector<std::string> set;
  double alpha = 0.01;
  int seeds = 0, workers = 2;
};

std::string ToJsonText(const GateResult& result, const Baseline& baseline) {
  nlohmann::json metrics = nlohmann::json::array();
  for (const auto& line : result.lines) {
    metrics.push_back({{"key", line.metric.key},
                       {"arm", line.place.arm},
                       {"point", line.place.point},
                       {"pairs", line.pairs},
                       {"baseline_mean", line.baseline_mean},
                       {"mean", line.mean},
                       {"log_e", line.log_e}});
  }
  return analysis::JsonText({{"verdict", core::EnumName(result.verdict)},
                             {"sentence", result.sentence},
                             {"seeds", result.seeds},
                             {"episodes", result.episodes},
                             {"p_value", result.p_value},
                             {"baseline_version", baseline.version},
                             {"baseline_cpu", baseline.cpu},
                             {"metrics", std::move(metrics)}});
}

int ExitCodeOf(const GateResult& result) {
  if (!result.disk_problem.empty()) return kFileError;
  switch (result.verdict) {
    case GateVerdict::kInterrupted:
      return kStopped;
    case GateVerdict::kWorse:
    case GateVerdict::kBroken:
      return kFailed;
    case GateVerdict::kEqual:
    case GateVerdict::kNoEvidence:
      break;
  }
  return kOk;
}

int RunCommand(const GateArguments& o) {
  const Baseline baseline = LoadBaseline(o.baseline);
  GateOptions options;
  options.file = o.file;
  options.overrides = o.set;
  options.twin = o.twin;
  options.walked = o.walked;
  options.alpha = o.alpha;
  options.seeds = o.seeds;
  options.workers = o.workers;
  options.folder = o.out.empty() ? std::filesystem::path("out") / "gate" /
                                       core::FileNameOf(baseline.results.name)
                                 : std::filesystem::path(o.out);
  options.program = std::filesystem::read_symlink("/proc/self/exe").string();
  options.baseline_program = o.baseline_program;
  options.interrupted = &Interrupted();
  options.on_line = [](const std::string& line) {
    fmt::print("{}\n", line);
    std::fflush(stdout);
  };
  const GateResult result = RunGate(baseline, options);
  if (!result.disk_problem.empty()) Note(result.disk_problem);
  fmt::print("{}\n", result.sentence);
  if (!o.json.empty()) core::WriteText(o.json, ToJsonText(result, baseline));
  return ExitCodeOf(result);
}

}  // namespace

void AddGate(CLI::App& app, int& exit_code) {
  auto o = std::make_shared<GateArguments>();
  CLI::App* gate = app.add_subcommand(
      "gate", "fail on evidence that episodes are worse than those of a baseline's campaign");
  gate->add_option("campaign", o->file, "campaign YAML (default: that of the baseline)");
  gate->add_option("--baseline", o->baseline, "folder of a campaign of many seeds")
      ->required()
      ->check(CLI::ExistingDirectory);
  gate->add_option("--baseline-program", o->baseline_program,
                   "the scoria that walked the baseline, for further seeds");
  gate->add_option(
          "--twin", o->twin,
          "campaign folder of the baseline's seeds and build, by other bits of no consequence: "
          "tells how much walks differ where nothing changed")
      ->check(CLI::ExistingDirectory);
  gate->add_option(
          "--walked", o->walked,
          "campaign folder that this build has walked already, as on a cluster: it is judged, and "
          "nothing is walked")
      ->check(CLI::ExistingDirectory);
  gate->add_option("--set", o->set, "override a key of the campaign");
  gate->add_option("--alpha", o->alpha, "probability of an alarm where nothing became worse")
      ->check(CLI::Range(1e-9, 0.5));
  gate->add_option("--seeds", o->seeds, "budget (default: the seeds of the baseline)")
      ->check(CLI::Range(1, 100'000));
  gate->add_option("-j,--workers", o->workers, "processes at a time")->check(CLI::Range(1, 1024));
  gate->add_option("--out", o->out, "folder for the episodes (default out/gate/NAME)");
  gate->add_option("--json", o->json, "file for the verdict with every metric");
  gate->callback([o, &exit_code] { exit_code = RunCommand(*o); });
}

}  // namespace scoria::app
