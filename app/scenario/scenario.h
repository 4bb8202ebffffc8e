// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/episode/fall_params.h"
#include "app/episode/operator.h"
#include "app/scenario/expectation.h"
#include "controller/controller.h"
#include "core/robot/description.h"
#include "sim/payload.h"
#include "sim/plant/plant.h"
#include "sim/sensors/faults.h"
#include "sim/sensors/sensor_params.h"
#include "sim/sliding_payload.h"
#include "terrains/params.h"

namespace scoria::app {

enum class StartPose { kLying, kStanding };
constexpr std::array<std::pair<StartPose, std::string_view>, 2> EnumNames(StartPose) {
  return {{{StartPose::kLying, "lying"}, {StartPose::kStanding, "standing"}}};
}

enum class KeepLog { kFull, kFalls, kMetrics };
constexpr std::array<std::pair<KeepLog, std::string_view>, 3> EnumNames(KeepLog) {
  return {{{KeepLog::kFull, "full"}, {KeepLog::kFalls, "falls"}, {KeepLog::kMetrics, "metrics"}}};
}

enum class LogTopics { kAll, kReference };
constexpr std::array<std::pair<LogTopics, std::string_view>, 2> EnumNames(LogTopics) {
  return {{{LogTopics::kAll, "all"}, {LogTopics::kReference, "reference"}}};
}

struct LogParams {
  KeepLog keep = KeepLog::kFull;
  LogTopics topics = LogTopics::kAll;
  double before_fall_s = 8.0, after_fall_s = 2.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("keep", keep, {.doc = "everything, the time around each fall, or nothing but metrics"});
    a.Field("topics", topics,
            {.doc = "all, or those that the reference framework's recorder writes, as in its field "
                    "logs: no rows, which report, render and replay --set need; replay --variant, "
                    "analyze and compare read such a log by its mapping"});
    a.Field("before_fall_s", before_fall_s, {.min = 0.0, .max = 600.0});
    a.Field("after_fall_s", after_fall_s, {.min = 0.0, .max = 600.0});
  }
};

/// A level push on the trunk's centre of mass, with constant force.
struct Push {
  double at_s = 0.0, duration_s = 0.1;
  double impulse_Ns = 0.0;
  double azimuth_rad = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("at_s", at_s, {.min = 0.0, .doc = "since the robot stands"});
    a.Field("duration_s", duration_s, {.min = 0.001, .max = 60.0});
    a.Required("impulse_Ns", impulse_Ns, {.min = 0.0, .max = 1000.0});
    a.Field("azimuth_rad", azimuth_rad,
            {.doc = "from the robot's heading when it starts: 0 forwards, pi/2 to the left"});
  }
};

/// Variants and parameters of the controller that change while it walks.
struct ControllerChange {
  double at_s = 0.0;
  std::vector<std::string> set;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("at_s", at_s, {.min = 0.0, .doc = "since the robot stands"});
    a.Required("set", set, {.doc = "keys below controller with their values, as gait.type=ags"});
  }
};

enum class Solver { kMpc, kBody };
constexpr std::array<std::pair<Solver, std::string_view>, 2> EnumNames(Solver) {
  return {{{Solver::kMpc, "mpc"}, {Solver::kBody, "body"}}};
}

/// A solver that gives no answer in time for a while.
struct SolverOutage {
  double at_s = 0.0, duration_s = 1.0;
  Solver solver = Solver::kMpc;
  controller::SolverFault kind = controller::SolverFault::kFail;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("at_s", at_s, {.min = 0.0, .doc = "since the robot stands"});
    a.Required("duration_s", duration_s, {.min = 0.0, .max = 1e6});
    a.Required("solver", solver, {.doc = "mpc, or body: the whole-body controller"});
    a.Field("kind", kind, {.doc = "of every answer meanwhile"});
  }
};

/// Faults of the controller's solvers, to see what its fallbacks are worth.
struct SolverFaultParams {
  double share = 0.0;
  std::vector<SolverOutage> outages;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("share", share,
            {.min = 0.0,
             .max = 1.0,
             .doc = "of MPC and WBC ticks, at random, at which the solver fails, returns NaN or is "
                    "late, a third each"});
    a.Field("outages", outages);
  }
};

/// One experiment.
struct Scenario {
  std::string name;
  std::uint64_t seed = 1;
  double duration_s = 60.0;
  core::RobotConfig robot;
  terrains::TerrainParams terrain;
  double gravity_mps2 = 9.81;
  sim::PhysicsParams physics;
  sim::SensorParams sensors;
  StartPose start = StartPose::kStanding;
  OperatorParams operation = RouteParams{};
  std::vector<Push> pushes;
  std::vector<sim::SensorFault> sensor_faults;
  std::vector<sim::PayloadEvent> payloads;
  std::optional<sim::SlidingPayloadParams> sliding_payload;
  SolverFaultParams solver_faults;
  controller::ControllerParams controller;
  std::vector<ControllerChange> controller_changes;
  FallParams fall;
  int max_falls = 1000;
  LogParams log;
  Expectations expect;
  core::Similarity similarity;  // of the robot: what the text does not give is scaled by it
  core::ConfigNotes notes;      // about the text that it was read from
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("name", name);
    a.Field("seed", seed, {.doc = "master seed of every random stream"});
    a.Field("duration_s", duration_s, {.min = 0.1, .max = 1e6, .doc = "time limit"});
    a.Required("robot", robot, {.doc = "usually base: ../robots/NAME/NAME.yaml"});
    a.Field("terrain", terrain, {.doc = "usually base: ../terrains/NAME.yaml"});
    a.Field("gravity_mps2", gravity_mps2, {.min = 0.1, .max = 30.0});
    a.Field("physics", physics);
    a.Field("sensors", sensors);
    a.Field("start", start);
    a.Field("operator", operation);
    a.Field("pushes", pushes);
    a.Field("sensor_faults", sensor_faults);
    a.Field("payloads", payloads, {.doc = "what the trunk carries, and when that changes"});
    a.Field("sliding_payload", sliding_payload, {.doc = "on a spring and damper, from the start"});
    a.Field("solver_faults", solver_faults);
    a.Field("controller", controller);
    a.Field("controller_changes", controller_changes);
    a.Field("fall", fall);
    a.Field("max_falls", max_falls, {.min = 0, .max = 1e6, .doc = "the episode ends at this many"});
    a.Field("log", log);
    a.Field("expect", expect,
            {.doc = "what scoria check holds the episode to: bounds by name of a metric, as falls "
                    "or tracking.height_rmse_mm, of events.KIND, supervisor.MONITOR or "
                    "counters.NAME"});
  }
  [[nodiscard]] std::string Problem() const;
};

/// The controller after each of the scenario's changes. Errors: core::ConfigError.
[[nodiscard]] std::vector<controller::ControllerParams> ChangedControllers(
    const Scenario& scenario);

/// @returns true if the controller needs the truth now or after a change.
[[nodiscard]] bool NeedsTruthEver(const Scenario& scenario);

/// The robot's section of a scenario, its defaults unscaled.
/// Errors: core::ConfigError.
[[nodiscard]] core::RobotConfig ReadRobotSection(const core::ConfigNode& scenario);

/// A robot from its YAML, with the defaults of its size.
/// Errors: core::ConfigError.
[[nodiscard]] core::RobotDescription ReadScaledRobot(const core::ConfigNode& robot);

/// @param similarity  of the robot that the scenario names.
/// Errors: core::ConfigError.
[[nodiscard]] Scenario ReadScenario(const core::ConfigNode& node,
                                    const core::Similarity& similarity);

/// As above, the robot's files read for it.
[[nodiscard]] Scenario ReadScenario(const core::ConfigNode& node);

/// Reads and checks a scenario file with command-line overrides "key.sub=value".
/// Errors: core::ConfigError.
[[nodiscard]] Scenario LoadScenario(const std::filesystem::path& file,
                                    const std::vector<std::string>& overrides);

/// The scenario with every default filled in, as YAML that LoadScenario reads back.
[[nodiscard]] std::string EffectiveYaml(const Scenario& scenario);

}  // namespace scoria::app
