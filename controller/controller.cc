// SPDX-License-Identifier: BSD-3-Clause
#include "controller/controller.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace scoria::controller {
namespace {

int EverySteps(double rate_Hz, double step_s) {
  return std::max(1, static_cast<int>(std::lround(1.0 / (rate_Hz * step_s))));
}

/// Joint control of the pose as it is, until the first tick of the hierarchy.
StandUpParams HoldOnly(StandUpParams params) {
  params.duration_s = 1e-6;
  params.hold_s = 0.0;
  return params;
}

/// Wall-clock stopwatch; its reading goes to the record only.
class Stopwatch {
 public:
  [[nodiscard]] double seconds() const noexcept {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

Controller::Controller(const ControllerParams& params, const core::RobotDescription& robot,
                       double gravity_mps2, double step_s, Start start, std::int64_t first_step)
    : params_(params),
      clock_(step_s, first_step),
      first_step_(first_step),
      mpc_every_(EverySteps(params.rates.mpc_Hz, step_s)),
      wbc_every_(EverySteps(params.rates.wbc_Hz, step_s)),
      operating_(false),
      model_(robot, gravity_mps2),
      foot_radius_m_(robot.legs[Leg::kFL].foot_radius_m),
      estimator_(MakeStateEstimator(params.estimator)),
      stand_up_(start == Start::kLying ? params.stand_up : HoldOnly(params.stand_up),
                StandingPose(robot, robot.config.nominal_height_m)),
      gait_(MakeGaitSequencer(params.gait, robot.config.nominal_height_m)),
      reference_planner_(params.reference, robot.config.nominal_height_m),
      foothold_planner_(params.foothold, robot, gravity_mps2),
      leg_states_(params.legs),
      swing_(params.swing, robot),
      mpc_(params.mpc, robot, gravity_mps2),
      wbc_(params.wbc, robot) {}

const ControlOutput& Controller::Step(const SensorFrame& z, const Command& command) noexcept {
  out_.estimate = estimator_->Update(z);
  out_.mpc_updated = out_.wbc_updated = false;
  if (!operating_) {
    const double since_s = static_cast<double>(clock_.step() - first_step_) * clock_.step_s();
    out_.command = stand_up_.Update(z, since_s);
    operating_ = stand_up_.IsDone(since_s) && clock_.Due(mpc_every_);
  }
  if (operating_) {
    const bool plans_due = clock_.Due(mpc_every_), body_due = clock_.Due(wbc_every_);
    if (plans_due || body_due) model_.Calc(out_.estimate.state, wb_);
    if (plans_due) StepPlans(command);
    if (body_due) StepBody();
  }
  out_.operating = operating_;
  clock_.Advance();
  return out_;
}

void Controller::StepPlans(const Command& command) noexcept {
  const double dt_s = mpc_every_ * clock_.step_s();
  reference_planner_.ObserveFeet(wb_, out_.estimate.contact, foot_radius_m_);
  reference_ =
      reference_planner_.Plan(wb_, command, params_.mpc.horizon, params_.mpc.stage_s, dt_s);

  GaitInput gait;
  gait.command = command;
  gait.v_xy_mps = wb_.v_WC.head<2>().norm();
  gait.w_z_radps = wb_.state.w_WB.z();
  gait.height_m = wb_.p_WC.z() - reference_.ground_z_m;
  for (const Leg leg : kLegs)
    gait.early_contact[leg] = out_.legs.mode[leg] == LegMode::kEarlyContact;
  gait.dt_s = dt_s;
  gait.horizon = params_.mpc.horizon;
  gait.stage_s = params_.mpc.stage_s;
  out_.contacts = gait_->Plan(gait);
  plan_step_ = clock_.step();
  out_.legs = leg_states_.Update(out_.contacts, out_.estimate.contact, 0.0, 0.0);
  footholds_ =
      foothold_planner_.Plan(wb_, out_.contacts, out_.legs, reference_, reference_planner_.plane());

  const Stopwatch watch;
  const MpcResult result = mpc_.Solve({wb_, out_.contacts, out_.legs, reference_, footholds_});
  out_.mpc_solve_s = watch.seconds();
  out_.mpc_status = result.status;
  out_.mpc_iterations = result.iterations;
  out_.mpc_updated = true;
  out_.reference = reference_.stages[0];
  out_.ground_z_m = reference_.ground_z_m;
  if (!IsUsable(result.status)) ++counters_.mpc_failures;

  // A result becomes active latency_ticks after its state was taken; a failed one never does.
  const auto size = static_cast<std::int64_t>(pending_.size());
  pending_[static_cast<std::size_t>(mpc_tick_ % size)] = {result.plan, clock_.step()};
  const std::int64_t due = std::max<std::int64_t>(0, mpc_tick_ - params_.mpc.latency_ticks);
  const PendingPlan& ready = pending_[static_cast<std::size_t>(due % size)];
  if (ready.plan.valid) active_ = ready;
  ++mpc_tick_;
}

void Controller::StepBody() noexcept {
  const double age_s = static_cast<double>(clock_.step() - plan_step_) * clock_.step_s();
  out_.legs =
      leg_states_.Update(out_.contacts, out_.estimate.contact, age_s, wbc_every_ * clock_.step_s());
  counters_.early_contacts = leg_states_.early_contacts();
  out_.feet = swing_.Plan(wb_, out_.legs, footholds_);
  if (!active_.plan.valid) return;

  const Stopwatch watch;
  const double plan_age_s = static_cast<double>(clock_.step() - active_.step) * clock_.step_s();
  const WbcResult result =
      wbc_.Solve({wb_, out_.legs, out_.feet, active_.plan, plan_age_s, reference_.n_W});
  out_.wbc_solve_s = watch.seconds();
  out_.wbc_status = result.status;
  out_.wbc_iterations = result.iterations;
  out_.wbc_updated = true;
  if (result.torque_rows_dropped) ++counters_.wbc_torque_drops;
  if (!IsUsable(result.status)) {
    ++counters_.wbc_failures;  // the last command stays in force
    return;
  }
  out_.command = result.command;
  out_.f_F_W = result.f_F_W;
  out_.target = result.target;
}

}  // namespace scoria::controller
