// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands.h"

#include <atomic>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <memory>
#include <numbers>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/report.h"
#include "analysis/video/video.h"
#include "app/campaign/campaign.h"
#include "app/campaign/report_picture.h"
#include "app/cli/progress.h"
#include "app/inspect/bench.h"
#include "app/inspect/inspection.h"
#include "app/inspect/qp_check.h"
#include "app/rerun/replay.h"
#include "app/rerun/verify.h"
#include "app/run/episode_files.h"
#include "app/run/log_origin.h"
#include "app/run/run_folder.h"
#include "app/scenario/config_docs.h"
#include "app/scenario/config_kinds.h"
#include "app/scenario/scenario.h"
#include "core/files.h"
#include "core/robot/mesh_records.h"
#include "logs/read_rows.h"

namespace scoria::app {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::atomic<bool> g_interrupted = false;  // the only state that a signal handler may touch

void CatchInterrupts() {
  for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { g_interrupted = true; });
}

/// A line on standard error, which may be a file on a full disk: no exception then.
void Note(const std::string& text) { std::fputs((text + "\n").c_str(), stderr); }

void PrintEstimation(const char* what, const analysis::EstimationMetrics& m) {
  const analysis::DriftSummary drift = analysis::SummariseDrift(m);
  fmt::print(
      "  {:9} drift {:.2f} % horizontal, {:.2f} % vertical, {:.3f} deg/m yaw; velocity {:.4f} m/s, "
      "roll {:.2f} deg, pitch {:.2f} deg RMSE; {}contact {:.2f} % right\n",
      what, drift.horizontal_pct, drift.vertical_pct, drift.yaw_deg_per_m, m.velocity_rmse_mps,
      m.roll_rmse_rad * kDegrees, m.pitch_rmse_rad * kDegrees,
      m.nees_rows > 0 ? fmt::format("NEES/5 {:.2f}; ", m.nees_ratio) : "",
      100.0 * m.contact.of(analysis::ContactWord::kCounted).Accuracy());
}

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
    CatchInterrupts();
    RunOptions options;
    const std::filesystem::path preferred =
        std::filesystem::path("out") / core::FileNameOf(scenario.name);
    const RunFolder folder = TakeRunFolder(o->out, preferred, o->force);
    if (o->out.empty() && folder.path != preferred)
      Note(fmt::format("{} is taken; writing to {}", preferred.string(), folder.path.string()));
    options.folder = folder.path;
    options.interrupted = &g_interrupted;
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

void PrintOutcome(const std::string& name, const CampaignOutcome& outcome,
                  const std::string& folder) {
  if (!outcome.disk_problem.empty()) Note(outcome.disk_problem);
  fmt::print("{}: {} episodes ({} from before, {} crashed, {} did not walk){} in {}\n", name,
             outcome.episodes, outcome.done_before, outcome.crashed, outcome.failed,
             outcome.interrupted ? ", interrupted" : "", folder);
  if (outcome.unfinished > 0) {
    fmt::print("{} episodes are to be walked yet; {}the same command goes on with them\n",
               outcome.unfinished, outcome.disk_problem.empty() ? "" : "make room, and then ");
  }
}

void AddCampaign(CLI::App& app, int& exit_code) {
  struct Options {
    std::string file, out;
    std::vector<std::string> set;
    int workers = 2;
  };
  auto o = std::make_shared<Options>();
  CLI::App* campaign =
      app.add_subcommand("campaign", "walk arms x sweep x seeds in worker processes; resumes");
  campaign->add_option("campaign", o->file, "campaign YAML")->required();
  campaign->add_option("--set", o->set,
                       "override a key, as seeds=10 or scenario.operator.distance_m=50");
  campaign->add_option("--out", o->out, "folder for the results (default out/NAME)");
  campaign->add_option("--workers", o->workers, "processes at a time")->check(CLI::Range(1, 1024));
  campaign->callback([o, &exit_code] {
    const Campaign loaded = LoadCampaign(o->file, o->set);
    CatchInterrupts();
    CampaignOptions options;
    options.folder = o->out.empty() ? std::filesystem::path("out") / core::FileNameOf(loaded.name)
                                    : std::filesystem::path(o->out);
    options.workers = o->workers;
    options.program = std::filesystem::read_symlink("/proc/self/exe").string();
    options.interrupted = &g_interrupted;
    options.on_again = [](const std::string& reason, int episodes) {
      Note(fmt::format("walked again: {} ({})",
                       episodes == 1 ? "1 episode" : fmt::format("{} episodes", episodes), reason));
    };
    const CampaignOutcome outcome = RunCampaign(loaded, options);
    PrintOutcome(loaded.name, outcome, options.folder.string());
    const bool stopped = outcome.interrupted || outcome.unfinished > 0;
    exit_code = !outcome.disk_problem.empty() ? kFileError : stopped ? kStopped : kOk;
  });
}

void AddReport(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  CLI::App* report =
      app.add_subcommand("report", "write FOLDER/report/report.html of a run or campaign");
  report->add_option("folder", *folder, "what run or campaign wrote")->required();
  report->callback([folder] {
    fmt::print("{}\n", analysis::WriteReport(*folder, MakeReportPicture(*folder)).string());
  });
}

/// @returns what is wrong with the width or height of a video; empty if nothing.
std::string CheckFrameEdge(const std::string& text) {
  int edge_px = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), edge_px);
  if (error != std::errc{} || stop != text.data() + text.size())
    return fmt::format("\"{}\" is not a number of pixels", text);
  const bool fits = edge_px >= analysis::kSmallestFrame_px && edge_px <= analysis::kLargestFrame_px;
  return fits ? ""
              : fmt::format(
                    "{} is outside [{}, {}] px: smaller frames hold no text, larger ones "
                    "no player shows",
                    edge_px, analysis::kSmallestFrame_px, analysis::kLargestFrame_px);
}

void AddRender(CLI::App& app) {
  struct Options {
    std::string log, out, frames;
    double from_s = 0.0, to_s = 1e9;
    std::vector<int> size = {960, 540};
    int fps = 30;
  };
  auto o = std::make_shared<Options>();
  CLI::App* render = app.add_subcommand("render", "make an H.264 video of a log, without a screen");
  render->add_option("log", o->log, "MCAP log that scoria wrote")->required();
  render->add_option("--out", o->out, "video file (default: beside the log)");
  render->add_option("--frames", o->frames, "folder for a PNG every five seconds");
  render->add_option("--from", o->from_s, "start [s]");
  render->add_option("--to", o->to_s, "end [s]");
  render->add_option("--size", o->size, "width and height [px], as 960 540 or 960x540")
      ->expected(2)
      ->delimiter('x')
      ->check(CLI::Validator(CheckFrameEdge, ""));
  render->add_option("--fps", o->fps, "frames per second")->check(CLI::Range(1, 240));
  render->callback([o] {
    analysis::VideoOptions options;
    options.file = o->out.empty() ? std::filesystem::path(o->log).replace_extension(".mp4")
                                  : std::filesystem::path(o->out);
    analysis::CheckVideoFile(options.file);  // before the long way there
    const LogOrigin origin = ReadLogOrigin(o->log);
    core::RobotDescription robot = RobotOf(origin);
    for (const std::string& remark : core::DrawLostMeshesAsBoxes(robot)) Note(remark);
    const terrains::Heightfield ground = GroundOf(origin);
    logs::LogContent content = logs::ReadLog(o->log);
    if (!content.problem.empty()) Note(content.problem);
    std::erase_if(content.rows, [&](const logs::LogRow& r) {
      const bool finite = std::isfinite(r.p_WB_m[0] + r.p_WB_m[1] + r.p_WB_m[2]);
      return !finite || r.time_s < o->from_s || r.time_s > o->to_s;
    });
    options.frames = o->frames;
    options.width_px = o->size[0];
    options.height_px = o->size[1];
    options.fps = o->fps;
    options.title = origin.scenario.name;
    {
      ProgressBar bar("video");
      options.on_progress = [&](double share) { bar.Update(share, ""); };
      analysis::RenderVideo(content.rows, robot, ground, options);
    }
    fmt::print("{}\n", options.file.string());
  });
}

void AddCheckQps(CLI::App& app, int& exit_code) {
  auto folder = std::make_shared<std::string>();
  CLI::App* check =
      app.add_subcommand("check-qps", "check the optimality conditions of saved QPs, one by one");
  check->add_option("folder", *folder, "what run --save-qps wrote")->required();
  check->callback([folder, &exit_code] {
    for (const QpCheck& c : CheckQpSets(*folder)) {
      fmt::print(
          "{:16} {} problems: primal {:.1e}, dual {:.1e}, stationarity {:.1e}, complementarity "
          "{:.1e}: {}\n",
          c.file, c.records, c.primal, c.dual, c.stationarity, c.complementarity,
          c.Holds() ? "optimal" : "NOT optimal");
      if (!c.Holds()) exit_code = kFailed;
    }
  });
}

void AddSchema(CLI::App& app) {
  struct Options {
    std::string kind = "scenario";
    bool markdown = false;
  };
  auto o = std::make_shared<Options>();
  CLI::App* schema = app.add_subcommand("schema", "print the keys of a YAML file as a JSON Schema");
  std::vector<std::string> kinds;
  for (const ConfigKind& kind : ConfigKinds()) kinds.emplace_back(kind.name);
  schema->add_option("kind", o->kind, "kind of file (default scenario)")
      ->check(CLI::IsMember(kinds));
  schema->add_flag("--markdown", o->markdown, "all kinds as the tables of docs/CONFIG.md");
  schema->callback(
      [o] { fmt::print("{}", o->markdown ? ConfigMarkdown() : ConfigJsonSchema(o->kind)); });
}

void AddVerify(CLI::App& app, int& exit_code) {
  auto log = std::make_shared<std::string>();
  CLI::App* verify = app.add_subcommand("verify", "re-run a log and compare it bit for bit");
  verify->add_option("log", *log, "MCAP log that scoria wrote")->required();
  verify->callback([log, &exit_code] {
    const VerifyResult result = VerifyLog(*log);
    if (!result.file_problem.empty()) fmt::print("{}\n", result.file_problem);
    if (result.identical) {
      fmt::print("identical: {} messages{}\n", result.messages,
                 result.complete ? "" : fmt::format(", up to {:.3f} s", result.until_s));
    } else {
      fmt::print("first difference after {} equal messages: {}\n",
                 result.messages > 0 ? result.messages - 1 : 0, result.difference);
    }
    exit_code = result.identical ? kOk : kFailed;
  });
}

void AddReplay(CLI::App& app, int& exit_code) {
  struct Options {
    std::string log;
    std::vector<std::string> set;
  };
  auto o = std::make_shared<Options>();
  CLI::App* replay = app.add_subcommand(
      "replay", "estimate again from the inputs that a log holds, as they were or with --set");
  replay->add_option("log", o->log, "MCAP log that scoria wrote with log.keep=full")->required();
  replay->add_option("--set", o->set, "override a key, as controller.estimator.type=linear_kf");
  replay->callback([o, &exit_code] {
    const ReplayResult result = ReplayLog(o->log, o->set);
    if (!result.file_problem.empty()) fmt::print("{}\n", result.file_problem);
    fmt::print("replayed {} steps: {}\n", result.steps,
               result.identical
                   ? fmt::format("all {} estimates have the bits of the log", result.rows)
                   : fmt::format("estimates differ from {:.3f} s on", result.first_difference_s));
    PrintEstimation("logged", result.logged);
    PrintEstimation("replayed", result.replayed);
    if (!result.identical && o->set.empty()) exit_code = kFailed;
  });
}

}  // namespace

void AddCommands(CLI::App& app, int& exit_code) {
  AddRun(app, exit_code);
  AddCampaign(app, exit_code);
  AddReport(app);
  AddBench(app);
  AddCheckQps(app, exit_code);
  AddInspection(app);
  AddSchema(app);
  AddRender(app);
  AddVerify(app, exit_code);
  AddReplay(app, exit_code);
}

}  // namespace scoria::app
