// SPDX-License-Identifier: BSD-3-Clause
#include "app/inspect/bench.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/report/json_text.h"
#include "app/episode/run_episode.h"
#include "app/inspect/bench_logs.h"
#include "app/inspect/bench_workers.h"
#include "controller/estimation/inekf.h"
#include "controller/qp/sets/qp_bench.h"
#include "controller/stand_up.h"
#include "core/math/quantile.h"
#include "core/robot_files/load.h"
#include "core/stopwatch.h"
#include "sim/actuation.h"
#include "terrains/generator.h"

namespace scoria::app {
namespace {

constexpr int kCalls = 20000, kAtOnce = 20;  // the clock is too coarse for one call
constexpr double kPerCall_rad = 0.01;        // how fast the inputs of such calls change
constexpr double kUsPerS = 1e6;
constexpr int kMostRepeats = 1000, kMostMegabytes = 100'000;

struct BenchOptions {
  std::string folder, log, scenario = "scenarios/rough.yaml";
  std::vector<std::string> set;
  int repeats = 5, megabytes = 200;
  bool json = false;
};

/// Median and 99th percentile of times, in microseconds.
nlohmann::json Spread(const std::vector<double>& us) {
  return {{"median_us", core::SampleQuantile(us, 0.5)},
          {"p99_us", core::SampleQuantile(us, 0.99)},
          {"calls", us.size()}};
}

void Print(const std::string& name, const nlohmann::json& spread) {
  fmt::print("{:24} {:.2f} us median, {:.2f} us p99, {} calls\n", name,
             spread["median_us"].get<double>(), spread["p99_us"].get<double>(),
             spread["calls"].get<std::size_t>());
}

nlohmann::json ToJson(const controller::QpBenchmark& b) {
  return {{"file", b.file},
          {"kind", b.kind},
          {"problems", b.problems},
          {"solved", b.solved},
          {"worst_error", b.worst_error},
          {"worst_violation_N", b.worst_violation},
          {"median_us", b.median_us},
          {"p99_us", b.p99_us},
          {"iterations", b.mean_iterations},
          {"warm_problems", b.warm_problems},
          {"warm_solved", b.warm_solved},
          {"warm_median_us", b.warm_median_us},
          {"warm_p99_us", b.warm_p99_us},
          {"warm_iterations", b.warm_mean_iterations}};
}

void BenchQp(const BenchOptions& o) {
  nlohmann::json json = nlohmann::json::array();
  const controller::QpSolvers solvers = controller::MakeQpSolvers();
  for (const controller::QpBenchmark& b :
       controller::BenchmarkQpFiles(o.folder, solvers, o.repeats)) {
    json.push_back(ToJson(b));
    if (o.json) continue;
    fmt::print(
        "{:16} {:16} {}/{} solved, worst error {:.1e}, violation {:.1e} N, {:.1f} us median, "
        "{:.1f} us p99, {:.1f} iterations\n",
        b.file, b.kind, b.solved, b.problems, b.worst_error, b.worst_violation, b.median_us,
        b.p99_us, b.mean_iterations);
    if (b.warm_problems == 0) continue;
    fmt::print(
        "{:33} {}/{} solved from the tick before, {:.1f} us median, {:.1f} us p99, {:.1f} "
        "iterations\n",
        "", b.warm_solved, b.warm_problems, b.warm_median_us, b.warm_p99_us,
        b.warm_mean_iterations);
  }
  if (o.json) fmt::print("{}", analysis::JsonText(json));
}

/// Whole-body model at poses around standing, as the controller calls it.
void BenchModel(const BenchOptions& o) {
  const Scenario scenario = LoadScenario(o.scenario, o.set);
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const core::WholeBodyModel model(robot, scenario.gravity_mps2);
  RobotState state;
  state.q = controller::StandingPose(robot, robot.config.nominal_height_m);
  core::WholeBody wb;
  std::vector<double> us;
  double sink = 0.0;
  for (int i = 0; i < kCalls; ++i) {
    const core::Stopwatch stopwatch;
    for (int k = 0; k < kAtOnce; ++k) {
      for (Vec3& qd : state.qd) qd.setConstant(std::sin(kPerCall_rad * (kAtOnce * i + k)));
      model.Calc(state, wb);
      sink += wb.mass_kg;
    }
    us.push_back(stopwatch.seconds() * kUsPerS / kAtOnce);
  }
  nlohmann::json json = {{"model", Spread(us)}, {"mass_kg", sink / (kCalls * kAtOnce)}};
  if (o.json) {
    fmt::print("{}", analysis::JsonText(json));
  } else {
    Print("whole-body model", json["model"]);
  }
}

/// The invariant filter of a robot that stands on four feet: one prediction and one correction.
void BenchEstimator(const BenchOptions& o) {
  constexpr double kFoot_m = 0.003, kTurning_radps = 0.1, kStart_sigma = 0.01;
  const Scenario scenario = LoadScenario(o.scenario, o.set);
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const Mat3 I = Mat3::Identity();
  controller::InekfParams params;
  params.noise = {.gyro = 1e-7 * I,
                  .accel = 1e-5 * I,
                  .gyro_bias = 1e-10 * I,
                  .accel_bias = 1e-8 * I,
                  .contact = 1e-4 * I};
  const Vec3 at_rest_mps2(0.0, 0.0, scenario.gravity_mps2);
  params.gravity_W = -at_rest_mps2;
  controller::Inekf filter(params);
  filter.Set({}, kStart_sigma * kStart_sigma * controller::InekfCovariance::Identity());
  LegArray<controller::FootMeasurement> feet;
  for (const Leg leg : kLegs) {
    feet[leg] = {true, robot.NeutralFoothold(leg), kFoot_m * kFoot_m * I};
    feet[leg].p_SF_S.z() = -robot.config.nominal_height_m;
  }
  std::vector<double> us;
  double nis = 0.0;
  for (int i = 0; i < kCalls; ++i) {
    const core::Stopwatch stopwatch;
    for (int k = 0; k < kAtOnce; ++k) {
      const double angle_rad = kPerCall_rad * (kAtOnce * i + k);
      const Vec3 w_S = Vec3::Constant(kTurning_radps * std::sin(angle_rad));
      if (filter.Predict(at_rest_mps2, w_S, scenario.physics.step_s) ==
          controller::InekfStatus::kOk)
        nis += filter.Correct(feet).nis;
    }
    us.push_back(stopwatch.seconds() * kUsPerS / kAtOnce);
  }
  const nlohmann::json json = {{"estimator", Spread(us)}, {"nis", nis}};
  if (o.json) {
    fmt::print("{}", analysis::JsonText(json));
  } else {
    Print("predict and correct", json["estimator"]);
  }
}

/// Physics alone: the robot stands on the scenario's ground under joint control.
void BenchPhysics(const BenchOptions& o) {
  constexpr int kSteps = 5000;
  constexpr double kStiffness_Nm_per_rad = 100.0, kDamping_Nms_per_rad = 2.5;
  const Scenario scenario = LoadScenario(o.scenario, o.set);
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  sim::Plant plant(robot, ground, scenario.physics, {0.0, 0.0, -scenario.gravity_mps2});
  sim::Actuation actuation(robot);
  RobotState state;
  state.q = controller::StandingPose(robot, robot.config.nominal_height_m);
  state.p_WB.z() = -std::numeric_limits<double>::infinity();
  for (const Leg leg : kLegs) {
    const Vec3 p_BF = core::CalcLegKinematics(robot.legs[leg], state.q[leg]).p_BF;
    const double ground_z = ground.HeightAt(p_BF.x(), p_BF.y());
    state.p_WB.z() = std::max(state.p_WB.z(), ground_z + robot.legs[leg].foot_radius_m - p_BF.z());
  }
  plant.Reset(state);
  JointCommand command;
  command.q = state.q;
  command.kp_Nm_per_rad = LegArray<Vec3>(Vec3::Constant(kStiffness_Nm_per_rad));
  command.kd_Nms_per_rad = LegArray<Vec3>(Vec3::Constant(kDamping_Nms_per_rad));
  std::vector<double> us;
  for (int i = 0; i < kSteps; ++i) {
    const core::Stopwatch stopwatch;
    const RobotState& now = plant.truth().state;
    plant.Step(actuation.Update(command, {now.q, now.qd}, now.qd, scenario.physics.step_s));
    us.push_back(stopwatch.seconds() * kUsPerS);
  }
  const nlohmann::json json = {{"physics", Spread(us)}};
  if (o.json) {
    fmt::print("{}", analysis::JsonText(json));
  } else {
    Print("physics step, standing", json["physics"]);
  }
}

/// The whole loop: where the time of an episode goes.
void BenchEpisode(const BenchOptions& o) {
  const Scenario scenario = LoadScenario(o.scenario, o.set);
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const terrains::Heightfield ground =
      terrains::GenerateTerrain(scenario.terrain, scenario.seed, 0);
  const EpisodeResult r = RunEpisode(scenario, robot, ground);
  const double steps = r.duration_s / scenario.physics.step_s;
  nlohmann::json json = {{"scenario", scenario.name},
                         {"simulated_s", r.duration_s},
                         {"walked_m", r.walked_m},
                         {"real_time_factor", r.duration_s / r.times.sum()}};
  for (const auto& [stage, name] : EnumNames(core::Stage{}))
    json["us_per_step"][name] = r.times[stage] / steps * kUsPerS;
  if (o.json) {
    fmt::print("{}", analysis::JsonText(json));
    return;
  }
  fmt::print("{}: {:.1f} times real time over {:.0f} s and {:.1f} m\n", scenario.name,
             r.duration_s / r.times.sum(), r.duration_s, r.walked_m);
  for (const auto& [stage, name] : EnumNames(core::Stage{}))
    fmt::print("  {:26} {:6.2f} us per step {:5.1f} %\n", name, r.times[stage] / steps * kUsPerS,
               100.0 * r.times[stage] / r.times.sum());
}

/// Reading of logs: one that is given, or one of each format.
void BenchLogs(const BenchOptions& o) {
  const std::vector<LogBenchmark> all =
      o.log.empty() ? BenchmarkLogFormats(o.megabytes) : std::vector{BenchmarkLog(o.log, o.log)};
  nlohmann::json json = nlohmann::json::array();
  for (const LogBenchmark& b : all) {
    json.push_back({{"log", b.name},
                    {"file_bytes", b.file_bytes},
                    {"message_bytes", b.message_bytes},
                    {"messages", b.messages},
                    {"open_s", b.open_s},
                    {"read_s", b.read_s},
                    {"MB_per_s", b.MBPerS()}});
    if (o.json) continue;
    fmt::print("{:24} {:.0f} MB/s of messages: {} of them, opened in {:.3f} s, read in {:.3f} s\n",
               b.name, b.MBPerS(), b.messages, b.open_s, b.read_s);
  }
  if (o.json) fmt::print("{}", analysis::JsonText(json));
}

/// The throughput of two worker processes over that of one: the best of three pairs.
void BenchWorkers(const BenchOptions& o) {
  constexpr int kEpisodes = 6, kPairs = 3;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  nlohmann::json json = nlohmann::json::array();
  double best = 0.0;
  for (const WorkersPair& p :
       BenchmarkWorkers(LoadScenario(o.scenario, o.set), program, kEpisodes, kPairs)) {
    best = std::max(best, p.gain());
    json.push_back({{"one_s", p.one_s}, {"two_s", p.two_s}, {"gain", p.gain()}});
    if (!o.json)
      fmt::print("{} episodes: {:.2f} s with one worker, {:.2f} s with two, {:.2f} times\n",
                 kEpisodes, p.one_s, p.two_s, p.gain());
  }
  if (o.json) {
    fmt::print("{}", analysis::JsonText({{"pairs", json}, {"best_gain", best}}));
  } else {
    fmt::print("two workers have {:.2f} times the throughput of one, best of {}\n", best, kPairs);
  }
}

CLI::App* AddPart(CLI::App& bench, const std::string& name, const std::string& what,
                  const std::shared_ptr<BenchOptions>& o, void (*function)(const BenchOptions&)) {
  CLI::App* part = bench.add_subcommand(name, what);
  part->add_flag("--json", o->json, "print JSON");
  part->callback([o, function] { function(*o); });
  return part;
}

void AddScenario(CLI::App* part, const std::shared_ptr<BenchOptions>& o) {
  part->add_option("scenario", o->scenario, "scenario YAML (default scenarios/rough.yaml)");
  part->add_option("--set", o->set, "override a key, as operator.distance_m=5");
}

}  // namespace

void AddBench(CLI::App& app) {
  auto o = std::make_shared<BenchOptions>();
  CLI::App* bench = app.add_subcommand("bench", "time parts of the program");
  bench->require_subcommand(1);
  CLI::App* qp = AddPart(*bench, "qp", "solve and time the QP sets of a folder", o, BenchQp);
  qp->add_option("folder", o->folder, "folder of .bin sets")->required();
  qp->add_option("--repeats", o->repeats, "solves per problem, of which the median counts")
      ->check(CLI::Range(1, kMostRepeats));
  CLI::App* logs =
      AddPart(*bench, "logs", "time the reading of a log, or of one per format", o, BenchLogs);
  logs->add_option("log", o->log, "a log of any format; without it some are generated");
  logs->add_option("--megabytes", o->megabytes, "size of each generated log")
      ->check(CLI::Range(1, kMostMegabytes));
  AddScenario(AddPart(*bench, "model", "time the whole-body model", o, BenchModel), o);
  AddScenario(
      AddPart(*bench, "estimator", "time the invariant filter on four feet", o, BenchEstimator), o);
  AddScenario(
      AddPart(*bench, "physics", "time a physics step of a standing robot", o, BenchPhysics), o);
  AddScenario(
      AddPart(*bench, "episode", "walk a scenario and tell where the time goes", o, BenchEpisode),
      o);
  AddScenario(
      AddPart(*bench, "workers", "time episodes in one worker process and in two", o, BenchWorkers),
      o);
}

}  // namespace scoria::app
