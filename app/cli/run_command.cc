// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "app/cli/commands.h"
#include "app/cli/interrupts.h"
#include "app/cli/note.h"
#include "app/cli/print_estimation.h"
#include "app/cli/progress.h"
#include "app/run/run_folder.h"
#include "app/run/run_scenario.h"
#include "app/scenario/scenario.h"
#include "core/files.h"

namespace scoria::app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

void PrintSummary(const Scenario& scenario, const EpisodeReport& report,
                  const std::string& folder) {
  const EpisodeResult& r = report.result;
  const analysis::EpisodeMetrics& m = report.metrics;
  const analysis::TrackingErrors& t = m.tracking;
  fmt::print("{}: {} after {:.1f} s, {:.1f} m walked, {} falls, {} times stuck\n", scenario.name,
             core::EnumName(r.end), r.duration_s, m.distance_m, r.falls, r.stuck);
  fmt::print(
      "  speed         {:.3f} {:.3f} m/s, {:.3f} rad/s for a command of {:.3f} {:.3f} m/s, {:.3f} "
      "rad/s\n",
      t.velocity_x_mps, t.velocity_y_mps, t.yaw_rate_radps, t.command_x_mps, t.command_y_mps,
      t.command_yaw_radps);
  fmt::print(
      "  RMSE          velocity {:.4f} m/s (stride mean), height {:.1f} mm, roll {:.2f} deg, pitch "
      "{:.2f} deg\n",
      t.velocity_rmse_mps, t.height_rmse_m * 1e3, t.roll_rmse_rad * kDegrees,
      t.pitch_rmse_rad * kDegrees);
  if (t.drift_m > 0.0) fmt::print("  standing      drift {:.2f} mm\n", t.drift_m * 1e3);
  fmt::print(
      "  cost of transport  mech_abs {:.3f}, mech_pos {:.3f}, electrical {:.3f}, battery "
      "{:.3f}\n",
      m.cot_mech_abs, m.cot_mech_pos, m.cot_electrical, m.cot_battery);
  if (m.estimation.present) PrintEstimation("estimate", m.estimation);
  const analysis::EnergyBudget& b = m.budget;
  fmt::print(
      "  energy ledger {:.0f} J motors, {:.0f} J joints, {:.0f} J ground, {:.0f} J stored, "
      "{:.2f} % unexplained\n",
      b.motor_J, b.joint_J, b.contact_J, b.stored_J,
      b.motor_J != 0.0 ? 100.0 * b.error_J / std::abs(b.motor_J) : 0.0);
  fmt::print("  solve times   MPC {:.0f} us (p99 {:.0f}), WBC {:.1f} us (p99 {:.1f})\n",
             m.mpc.median_s * 1e6, m.mpc.p99_s * 1e6, m.wbc.median_s * 1e6, m.wbc.p99_s * 1e6);
  fmt::print("  real time     {:.1f}x;", report.real_time_factor);
  for (const auto& [stage, name] : EnumNames(core::Stage{}))
    fmt::print(" {} {:.0f} %,", name, 100.0 * r.times[stage] / r.times.sum());
  fmt::print(" of {:.1f} us per step\n",
             r.times.sum() / r.duration_s * scenario.physics.step_s * 1e6);
  fmt::print("  state hash    {:016x}\n  files         {}\n", r.state_hash, folder);
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
