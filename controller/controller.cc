// SPDX-License-Identifier: BSD-3-Clause
#include "controller/controller.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/config/scale.h"
#include "core/math/so3.h"
#include "core/rate.h"
#include "core/stopwatch.h"

namespace scoria::controller {
namespace {

Count CountOf(Monitor monitor) noexcept {
  return static_cast<Count>(static_cast<int>(Count::kFallbackMpc) + static_cast<int>(monitor));
}

}  // namespace

SensingParams SensingOf(const ControllerParams& params) {
  return {params.samples, params.contact, params.estimator, params.adaptation, params.model};
}

bool NeedsTruth(const ControllerParams& params) noexcept { return NeedsTruth(SensingOf(params)); }

Controller::Controller(const ControllerParams& params, const core::RobotDescription& robot,
                       double gravity_mps2, double step_s, const Start& start)
    : params_(params),
      robot_(robot),
      clock_(step_s, start.step),
      first_step_(start.step),
      mpc_every_(core::RateDivider(params.rates.mpc_Hz, step_s).every_steps()),
      wbc_every_(core::RateDivider(params.rates.wbc_Hz, step_s).every_steps()),
      operating_(false),
      foot_radius_m_(robot.legs[Leg::kFL].foot_radius_m),
      sensing_(SensingOf(params), robot, gravity_mps2, step_s, start.placement, start.model),
      stand_up_(params.stand_up,
                start.pose == Start::Pose::kLying
                    ? std::optional(StandingPose(robot, robot.config.nominal_height_m))
                    : std::nullopt),
      gait_(MakeGaitSequencer(params.gait, robot.config.nominal_height_m)),
      reference_planner_(params.reference, robot.config.nominal_height_m),
      foothold_planner_(params.foothold, robot, gravity_mps2),
      leg_states_(params.legs),
      swing_(params.swing, robot),
      mpc_(std::make_unique<MpcRunner>(params.mpc, robot, gravity_mps2)),
      wbc_(MakeWholeBodyController(params.wbc, robot)),
      fallback_(
          MakeWholeBodyController(core::Scaled(InverseDynamicsParams{}, robot.similarity), robot)),
      guard_(params.safety, robot, StandingPose(robot, robot.config.nominal_height_m)),
      quality_(params.quality),
      supervisor_(params.supervisor) {}

const ControlOutput& Controller::Step(const SensorFrame& z, const Command& command,
                                      const SolverFaults& faults,
                                      const TrueInputs& true_inputs) noexcept {
  out_.times = {};
  core::Lap lap(out_.times);
  Sense(z, true_inputs);
  lap.Book(core::Stage::kEstimation);
  out_.mpc_updated = out_.wbc_updated = false;
  out_.transitions.count = 0;
  if (!operating_) {
    const double since_s = static_cast<double>(clock_.step() - first_step_) * clock_.step_s();
    const RobotState& state = out_.estimate.state;
    out_.command =
        guard_.Check(stand_up_.Update(state.q, since_s), state, GuardMode::kStandUp, counters_);
    operating_ = stand_up_.IsDone(since_s) && out_.estimate.ready && clock_.Due(mpc_every_);
    mpc_since_ = clock_.step();
  }
  if (operating_) {
    const bool plans_due = clock_.Due(mpc_every_), body_due = clock_.Due(wbc_every_);
    if (plans_due) {
      StepPlans(command, true_inputs.ground);
      lap.Book(core::Stage::kPlans);
      mpc_->Submit();
      TakePlan(faults.mpc);
      lap.Book(core::Stage::kMpc);
    }
    if (body_due) {
      StepBody(faults.wbc);
      Supervise();
    }
    lap.Book(core::Stage::kBody);
  }
  out_.operating = operating_;
  clock_.Advance();
  return out_;
}

void Controller::Reconfigure(const ControllerParams& params) {
  const ControllerParams before = std::exchange(params_, params);
  const double gravity_mps2 = sensing_.model().gravity_mps2();
  sensing_.Reconfigure(SensingOf(params));
  sensing_.SetContactChoice(ContactChoiceInForce());
  if (params.gait != before.gait) {
    const PhaseEngine phases = gait_->phases();
    gait_ = MakeGaitSequencer(params.gait, robot_.config.nominal_height_m);
    gait_->Continue(phases);
  }
  if (params.mpc != before.mpc) {
    mpc_ = std::make_unique<MpcRunner>(params.mpc, robot_, gravity_mps2);
    mpc_since_ = (clock_.step() + mpc_every_ - 1) / mpc_every_ * mpc_every_;  // its first tick
  }
  if (params.wbc != before.wbc) wbc_ = MakeWholeBodyController(params.wbc, robot_);
  reference_planner_.set_params(params.reference);
  if (params.foothold != before.foothold) foothold_planner_.set_params(params.foothold);
  leg_states_.set_params(params.legs);
  swing_.set_params(params.swing);
  guard_.set_params(params.safety);
  quality_.set_params(params.quality);
  supervisor_.set_params(params.supervisor);
}

void Controller::Sense(const SensorFrame& raw, const TrueInputs& true_inputs) noexcept {
  const double plan_age_s = static_cast<double>(clock_.step() - contacts_step_) * clock_.step_s();
  static_cast<Sensed&>(out_) =
      sensing_.Step(raw, {out_.contacts, plan_age_s, reference_planner_.plane(), operating_},
                    true_inputs, counters_);
  out_.model_mass_kg = sensing_.wb().mass_kg;
}

void Controller::StepPlans(const Command& asked, const LocalGround* ground) noexcept {
  const core::WholeBody& wb = sensing_.wb();
  const Command command = supervisor_.Temper(asked, robot_.config.nominal_height_m);
  const double dt_s = mpc_every_ * clock_.step_s();
  if (ground != nullptr) {
    reference_planner_.ObserveGround(wb, *ground);
  } else {
    reference_planner_.ObserveFeet(wb, out_.contact.contact, foot_radius_m_, dt_s);
  }
  reference_ = reference_planner_.Plan(wb, command, params_.mpc.horizon, params_.mpc.stage_s, dt_s);

  GaitInput gait;
  gait.command = command;
  gait.v_xy_mps = wb.v_WC.head<2>().norm();
  gait.w_z_radps = wb.state.w_WB.z();
  gait.height_m = wb.p_WC.z() - reference_.ground_z_m;
  for (const Leg leg : kLegs) {
    gait.early_contact[leg] = out_.legs.mode[leg] == LegMode::kEarlyContact;
    gait.foot_error_m[leg] = foothold_planner_.DistanceFromNeutral(wb, leg);
  }
  gait.least_duty = supervisor_.care() * params_.supervisor.careful_duty;
  gait.dt_s = dt_s;
  gait.horizon = params_.mpc.horizon;
  gait.stage_s = params_.mpc.stage_s;
  out_.contacts = gait_->Plan(gait);
  contacts_step_ = clock_.step();
  out_.legs = leg_states_.Update(out_.contacts, out_.contact.contact, 0.0, 0.0, counters_);
  footholds_ = foothold_planner_.Plan(wb, out_.contacts, out_.legs, reference_,
                                      reference_planner_.plane(), ground);
  out_.reference = reference_.stages[0];
  out_.ground_z_m = reference_.ground_z_m;

  mpc_->input() = {wb, out_.contacts, out_.legs, reference_, footholds_};
}

/// The plan that is due becomes the one in force, unless it failed or is late.
void Controller::TakePlan(SolverFault fault) noexcept {
  const MpcRunner::Result& result = mpc_->Collect();
  out_.mpc_solve_s = result.solve_s;
  out_.mpc_status = fault == SolverFault::kFail ? SolveStatus::kNumerical : result.mpc.status;
  out_.mpc_iterations = result.mpc.iterations;
  out_.mpc_updated = true;
  DatedPlan due{result.mpc.plan, mpc_since_ + result.tick * mpc_every_};
  if (fault == SolverFault::kNan)
    due.plan.f_F_W[0][Leg::kFL].setConstant(std::numeric_limits<double>::quiet_NaN());
  if (late_.plan.valid) active_ = late_;
  late_ = {};
  if (!IsUsable(out_.mpc_status) || !due.plan.valid || !IsFinite(due.plan)) {
    counters_.Add(Count::kMpcFailure);
  } else if (fault == SolverFault::kLate) {
    counters_.Add(Count::kMpcLate);
    late_ = due;
  } else {
    active_ = due;
  }
}

void Controller::StepBody(SolverFault fault) noexcept {
  const core::WholeBody& wb = sensing_.wb();
  const double step_s = clock_.step_s();
  const double contacts_age_s = static_cast<double>(clock_.step() - contacts_step_) * step_s;
  out_.legs = leg_states_.Update(out_.contacts, out_.contact.contact, contacts_age_s,
                                 wbc_every_ * step_s, counters_);
  out_.feet = swing_.Plan(wb, out_.legs, footholds_,
                          supervisor_.care() * params_.supervisor.careful_lift_m);

  double plan_age_s = static_cast<double>(clock_.step() - active_.step) * step_s;
  ForcePlan plan = active_.plan;
  if (!plan.valid || plan_age_s > params_.safety.max_plan_age_s ||
      supervisor_.HasFallenBack(Monitor::kMpc)) {
    counters_.Add(Count::kPlanExpired);
    plan = StandInPlan(wb.mass_kg * sensing_.model().gravity_mps2(), out_.legs.Contacts(),
                       reference_, params_.mpc.stage_s);
    plan_age_s = 0.0;
  }
  const core::Stopwatch stopwatch;
  const WbcResult result =
      SolveBody({wb, out_.legs, out_.feet, plan, plan_age_s, reference_.n_W}, fault);
  out_.wbc_solve_s = stopwatch.seconds();
  torque_shortfall_ = CalcTorqueShortfall(plan);
  out_.wbc_updated = true;
  out_.wbc_status = result.status;
  out_.wbc_iterations = result.iterations;
  out_.command = guard_.Check(result.command, wb.state, GuardMode::kWalk, counters_);
  out_.f_F_W = result.f_F_W;
  out_.target = result.target;
}

/// The body controller's answer; where there is none, the last command for a while, then inverse
/// dynamics, which also stands in while the supervisor has given the body controller up. What even
/// that cannot answer, the guard damps.
WbcResult Controller::SolveBody(const WbcInput& in, SolverFault fault) noexcept {
  WbcResult result = wbc_->Solve(in);
  if (fault == SolverFault::kFail) result.status = SolveStatus::kNumerical;
  if (fault == SolverFault::kNan)
    result.command.tau_Nm[Leg::kFL].setConstant(std::numeric_limits<double>::quiet_NaN());
  if (result.torque_rows_dropped) counters_.Add(Count::kTorqueRowsDropped);
  if (result.singular_leg) counters_.Add(Count::kSingularLeg);
  const bool failed = !IsUsable(result.status) || !IsFinite(result.command);
  const bool on_fallback = supervisor_.HasFallenBack(Monitor::kBody);
  body_answered_ = !failed && fault != SolverFault::kLate;
  if (body_answered_ && !on_fallback) {
    command_step_ = clock_.step();
    return result;
  }
  if (!body_answered_) counters_.Add(failed ? Count::kWbcFailure : Count::kWbcLate);
  const double age_s = static_cast<double>(clock_.step() - command_step_) * clock_.step_s();
  if (!failed && !on_fallback && age_s <= params_.safety.max_command_age_s) {
    result.command = out_.command;
    return result;
  }
  counters_.Add(Count::kInverseDynamics);
  return fallback_->Solve(in);
}

/// What the planned forces of the stance legs ask of a motor beyond its limit, as a share of that;
/// of the one that lacks most.
double Controller::CalcTorqueShortfall(const ForcePlan& plan) const noexcept {
  const core::WholeBody& wb = sensing_.wb();
  const LegArray<Vec3> f_F_W = plan.ForcesFor(out_.legs.Contacts(), reference_.n_W);
  const LegArray<Vec3> effort_Nm = robot_.EffortLimits();
  double shortfall = 0.0;
  for (const Leg leg : kLegs) {
    if (!out_.legs.InContact(leg)) continue;
    const Vec3 tau_Nm = wb.h_l[leg] - wb.J_ll[leg].transpose() * f_F_W[leg];
    shortfall =
        std::max(shortfall, (tau_Nm.cwiseAbs().array() / effort_Nm[leg].array() - 1.0).maxCoeff());
  }
  return shortfall;
}

StageReports Controller::Report() const noexcept {
  StageReports reports{.legs = out_.legs, .contact = out_.contact.contact, .foot_lag_m = {}};
  const double plan_age_s = static_cast<double>(clock_.step() - active_.step) * clock_.step_s();
  reports.plan_age_share =
      active_.plan.valid ? plan_age_s / std::max(params_.safety.max_plan_age_s, plan_age_s) : 1.0;
  reports.body_answered = body_answered_;
  reports.torque_shortfall = torque_shortfall_;
  for (const Leg leg : kLegs)
    reports.foot_lag_m[leg] = (out_.feet[leg].p_WF - sensing_.wb().p_WF[leg]).norm();
  const RobotState& s = out_.estimate.state;
  reports.estimate_finite = s.R_WB.allFinite() && s.p_WB.allFinite() && s.v_WB.allFinite();
  reports.v_W = s.v_WB;
  reports.a_W = s.R_WB * robot_.R_BS * sensing_.last_samples().a_WS_S -
                sensing_.model().gravity_mps2() * Vec3::UnitZ();
  reports.nis = out_.estimate.nis;
  reports.nis_dof = out_.estimate.nis_dof;
  if (params_.contact.source == ContactChoice::kSensor && robot_.config.has_foot_sensors) {
    const auto& healthy = out_.contact.sensor_healthy;
    reports.sound_feet_share =
        static_cast<double>(std::count(healthy.begin(), healthy.end(), true)) / kNumLegs;
  }
  const Vec3 z_W = core::RotationFromRpy(out_.reference.rpy_rad).col(2);
  reports.tilt_error_rad = std::acos(std::clamp(z_W.dot(s.R_WB.col(2)), -1.0, 1.0));
  reports.slips = counters_[Count::kSlip];
  return reports;
}

void Controller::Supervise() noexcept {
  supervisor_.Update(quality_.Update(Report(), wbc_every_ * clock_.step_s()),
                     wbc_every_ * clock_.step_s());
  out_.qualities = quality_.qualities();
  out_.transitions = supervisor_.transitions();
  for (std::size_t i = 0; i < out_.transitions.count; ++i) Act(out_.transitions.list[i]);
  for (std::size_t i = 0; i < kNumMonitors; ++i)
    out_.fallen_back[i] = supervisor_.HasFallenBack(static_cast<Monitor>(i));
}

/// What is done once when a fallback is engaged or released; the rest follows from the supervisor's
/// state.
void Controller::Act(const Transition& transition) noexcept {
  if (transition.fell_back) counters_.Add(CountOf(transition.monitor));
  if (transition.monitor == Monitor::kEstimator && transition.fell_back) {
    // A tilt ξ too far turns gravity into the acceleration ξ × g z that the speed does not show.
    const Vec3 xi_W =
        Vec3::UnitZ().cross(quality_.acceleration_residual_W()) / sensing_.model().gravity_mps2();
    StateEstimate upright = out_.estimate;
    upright.state.R_WB = core::ExpSo3(-xi_W) * upright.state.R_WB;
    sensing_.ContinueEstimate(upright, params_.supervisor.covariance_scale);
  }
  if (transition.monitor == Monitor::kContact) sensing_.SetContactChoice(ContactChoiceInForce());
}

/// The chosen source, or the hierarchy while the supervisor has fallen back on it.
ContactChoice Controller::ContactChoiceInForce() const noexcept {
  return supervisor_.HasFallenBack(Monitor::kContact) ? ContactChoice::kHierarchy
                                                      : params_.contact.source;
}

}  // namespace scoria::controller
