// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/replay.h"

#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "app/episode/record.h"
#include "app/episode/rows.h"
#include "app/run/log_origin.h"
#include "logs/format/open_log.h"
#include "logs/messages/read_messages.h"
#include "logs/read_rows.h"
#include "logs/vectors.h"

namespace scoria::app {
namespace {

namespace msg = logs::msg;

template <class T>
LegArray<T> ToLegs(const std::array<T, 4>& v) {
  return {v[0], v[1], v[2], v[3]};
}

SensorFrame ToFrame(const msg::ControllerInput& m) {
  SensorFrame z;
  z.step = m.step;
  z.imu_time_s = m.imu_time_s;
  z.q = Unflatten(m.q_rad);
  z.qd = Unflatten(m.qd_radps);
  z.tau_Nm = Unflatten(m.tau_nm);
  z.a_WS_S = logs::ToVec3(m.specific_force_mps2);
  z.w_WS_S = logs::ToVec3(m.rate_radps);
  z.foot_force_raw = ToLegs(m.foot_force_raw);
  return z;
}

Command ToCommand(const msg::ControllerInput& m) {
  Command command;
  command.v_x_mps = m.v_x_mps;
  command.v_y_mps = m.v_y_mps;
  command.w_z_radps = m.w_z_radps;
  command.height_m = m.height_m;
  command.roll_rad = m.roll_rad;
  command.pitch_rad = m.pitch_rad;
  command.pattern = static_cast<GaitPattern>(m.pattern);
  return command;
}

controller::SolverFaults ToFaults(const msg::ControllerInput& m) {
  return {static_cast<controller::SolverFault>(m.mpc_fault),
          static_cast<controller::SolverFault>(m.wbc_fault)};
}

/// Whether two rows are equal in all that the first holds.
bool Agrees(const logs::Row& logged, logs::Row again) {
  const logs::RowGroups held = logs::GroupsOf(logged);
  logs::ForEachGroup(again, [&]<class Group>(std::optional<Group>& group) {
    if (!held[static_cast<std::size_t>(Group::kGroup)]) group.reset();
  });
  return again == logged;
}

/// One pass over a log.
class Replay {
 public:
  Replay(const Scenario& scenario, const core::RobotDescription& robot)
      : scenario_(scenario), robot_(robot), changes_(ChangedControllers(scenario)) {}

  void Take(const logs::LogMessage& m) {
    if (rows_.Add(m)) return;
    if (m.channel.topic == "/scoria/controller_start") {
      Start(logs::Decode<msg::ControllerStart>(m));
    } else if (m.channel.topic == "/scoria/controller_input") {
      Step(logs::Decode<msg::ControllerInput>(m));
    } else if (m.channel.topic == "/scoria/event") {
      const auto event = logs::Decode<msg::Event>(m);
      const bool change = event.kind == "controller_change" && next_change_ < changes_.size();
      if (!change) return;
      const controller::ControllerParams& params = changes_[next_change_++];
      if (controller_) controller_->Reconfigure(params);
    }
  }

  [[nodiscard]] const logs::RowJoiner& rows() const { return rows_; }

  /// @param problem  what is wrong with the log, if anything.
  ReplayResult Finish(const std::string& problem) {
    if (result_.steps == 0) {
      throw std::runtime_error(
          !problem.empty() ? problem + "; there are no controller inputs before that"
          : scenario_.log.keep == KeepLog::kFull
              ? "the log ends before the first controller input"
              : "the log holds no controller inputs from a start on; record it with log.keep=full");
    }
    if (result_.rows == 0)
      throw std::runtime_error((problem.empty() ? "" : problem + "; ") +
                               "the log holds no estimates to compare with");
    result_.file_problem = problem;
    result_.logged = logged_.Finish();
    result_.replayed = replayed_.Finish();
    return result_;
  }

 private:
  void Start(const msg::ControllerStart& m) {
    using Pose = controller::Start::Pose;
    const auto model = controller_ ? std::optional(controller_->model()) : std::nullopt;
    const controller::Start start{m.standing ? Pose::kStanding : Pose::kLying,
                                  {Vec2(m.x_m, m.y_m), m.ground_z_m, m.yaw_rad},
                                  m.step,
                                  model};
    controller_.emplace(next_change_ == 0 ? scenario_.controller : changes_[next_change_ - 1],
                        robot_, scenario_.gravity_mps2, scenario_.physics.step_s, start);
    next_step_ = m.step;
  }

  void Step(const msg::ControllerInput& m) {
    if (!controller_ || m.step != next_step_) return;
    ++next_step_;
    ++result_.steps;
    const controller::ControlOutput& out = controller_->Step(ToFrame(m), ToCommand(m), ToFaults(m));
    const logs::Row& logged = rows_.row();  // whole: a step's input is logged after its row
    const bool comparable = logged.estimate && logged.episode && logged.episode->step == m.step;
    if (comparable) Compare(logged, out);
  }

  void Compare(const logs::Row& logged, const controller::ControlOutput& out) {
    logs::Row again = logged;
    FillControl(out, robot_.config.has_foot_sensors, again);
    result_.groups |= logs::GroupsOf(logged);
    logged_.AddRow(logged);
    replayed_.AddRow(again);
    ++result_.rows;
    if (!Agrees(logged, again) && result_.identical) {
      result_.identical = false;
      result_.first_difference_s = logged.time_s;
    }
  }

  const Scenario& scenario_;
  const core::RobotDescription& robot_;
  std::vector<controller::ControllerParams> changes_;
  std::size_t next_change_ = 0;
  std::optional<controller::Controller> controller_;
  std::int64_t next_step_ = 0;
  logs::RowJoiner rows_{[](const logs::Row&) {}};
  analysis::EstimationAccumulator logged_, replayed_;
  ReplayResult result_;
};

}  // namespace

ReplayResult ReplayLog(const std::filesystem::path& log,
                       const std::vector<std::string>& overrides) {
  for (const std::string& assignment : overrides) {
    if (!assignment.starts_with("controller."))
      throw core::ConfigError(
          {}, "", fmt::format("--set {}: a replay can only change controller.*", assignment));
  }
  const LogOrigin origin = ReadLogOrigin(log, overrides);
  if (const std::string missing = MissingTopics(origin.scenario.log); !missing.empty())
    throw std::runtime_error(
        fmt::format("{}: {}, without the controller's inputs that a replay "
                    "needs; record it with log.topics=all",
                    log.string(), missing));
  if (NeedsTruthEver(origin.scenario))
    throw std::runtime_error(
        fmt::format("{}: a controller that runs on the truth cannot be replayed; choose other "
                    "stages with --set controller.estimator.type=inekf and "
                    "controller.contact.source=hierarchy",
                    log.string()));
  const core::RobotDescription robot = RobotOf(origin);
  const auto replay = std::make_unique<Replay>(origin.scenario, robot);
  const std::unique_ptr<logs::LogSource> source = logs::OpenLog(log);
  if (const std::string other = logs::DescribeOtherLayout(*source); !other.empty())
    throw std::runtime_error(fmt::format("{}: {}", log.string(), other));
  std::string problem =
      logs::ProblemText(logs::ReadMessages(*source, {.order = logs::LogOrder::kStored},
                                           [&](const logs::LogMessage& m) { replay->Take(m); }));
  if (const std::string rows = logs::DescribeRowProblems(*source, replay->rows()); !rows.empty())
    problem += fmt::format("{}{}: {}", problem.empty() ? "" : "; ", log.string(), rows);
  return replay->Finish(problem);
}

}  // namespace scoria::app
