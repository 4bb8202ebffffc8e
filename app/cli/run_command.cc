// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "analysis/metrics/metric_text.h"
#include "app/cli/commands.h"
#include "app/cli/interrupts.h"
#include "app/cli/note.h"
#include "app/cli/progress.h"
#include "app/run/run_folder.h"
#include "app/run/run_scenario.h"
#include "app/scenario/scenario.h"
#include "core/files.h"

namespace scoria::app {
namespace {

void PrintSummary(const Scenario& scenario, const EpisodeReport& report,
                  const std::string& folder) {
  const EpisodeResult& r = report.result;
  const analysis::EpisodeMetrics& m = report.metrics;
  fmt::print("{}: {} after {:.1f} s, {:.1f} m walked, {} falls, {} times stuck\n", scenario.name,
             core::EnumName(r.end), r.duration_s, m.distance_m, r.falls, r.stuck);
  fmt::print("{}", analysis::DescribeMetrics(analysis::AllMetrics(), m));
  fmt::print("  real time     {:.1f}x;", report.real_time_factor);
  for (const auto& [stage, name] : EnumNames(core::Stage{}))
    fmt::print(" {} {:.0f} %,", name, 100.0 * r.times[stage] / r.times.sum());
  fmt::print(" of {:.1f} us per step\n",
             r.times.sum() / r.duration_s * scenario.physics.step_s * 1e6);
  fmt::print("  engine        {}\n  state hash    {:016x}\n  files         {}\n",
             sim::EngineName(scenario.physics.engine), r.state_hash, folder);
}

}  // namespace

void AddRun(CLI::App& app, int& exit_code) {
  struct Options {
    std::string scenario, out, save_qps;
    std::vector<std::string> set;
    bool json = false, quiet = false, force = false;
  };
  auto o = std::make_shared<Options>();
  CLI::App* run = app.add_subcommand("run", "walk one scenario");
  run->add_option("scenario", o->scenario, "scenario YAML")->required();
  run->add_option("--set", o->set, "override a key, as operator.speed_mps=0.5");
  run->add_option(
      "--out", o->out,
      "folder for log and result (default out/NAME, or the first free of NAME-2, NAME-3 ...)");
  run->add_flag("--force", o->force, "overwrite a finished run in that folder");
  run->add_option("--save-qps", o->save_qps,
                  "folder for every MPC and WBC problem with its solution (17 MB per second)");
  run->add_flag("--json", o->json, "print result.json instead of a summary");
  run->add_flag("--quiet", o->quiet, "print nothing but what goes wrong");
  run->callback([o, &exit_code] {
    const Scenario scenario = LoadScenario(o->scenario, o->set);
    for (const std::string& note : scenario.notes) Note(note);
    RunOptions options;
    const std::filesystem::path preferred =
        std::filesystem::path("out") / core::FileNameOf(scenario.name);
    const RunFolder folder = TakeRunFolder(o->out, preferred, o->force);
    if (o->out.empty() && folder.path != preferred)
      Note(fmt::format("{} is taken; writing to {}", preferred.string(), folder.path.string()));
    options.folder = folder.path;
    options.interrupted = &Interrupted();
    options.save_qps = o->save_qps;
    if (!o->quiet) {
      options.on_warning = [](const std::string& warning) {
        fmt::print(stderr, "warning: {}\n", warning);
      };
    }
    EpisodeReport report;
    {
      ProgressBar bar(scenario.name);
      options.on_progress = [&](double time_s, int falls) {
        bar.Update(time_s / scenario.duration_s, fmt::format("{:.0f} s, {} falls", time_s, falls));
      };
      report = RunToFolder(scenario, options);
    }
    if (o->json) {
      std::ifstream in(options.folder / "result.json");
      fmt::print("{}", std::string(std::istreambuf_iterator<char>(in), {}));
    } else if (!o->quiet) {
      PrintSummary(scenario, report, options.folder.string());
    }
    const bool stopped = report.result.end == EpisodeEnd::kInterrupted;
    if (!report.failure.empty()) Note(scenario.name + ": " + report.failure);
    exit_code = stopped ? kStopped : report.failure.empty() ? kOk : kFailed;
  });
}

}  // namespace scoria::app
