// SPDX-License-Identifier: BSD-3-Clause
#include "app/rerun/log_observer.h"

#include <limits>

#include "core/math/so3.h"
#include "core/robot/stance_velocity.h"
#include "logs/vectors.h"

namespace scoria::app {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// What is absent is not finite: the guard of samples keeps the last good value.
LegArray<Vec3> OrNaN(const std::optional<logs::Array12>& v) {
  const Vec3 none = Vec3::Constant(kNaN);
  return v ? Unflatten(*v) : LegArray<Vec3>{none, none, none, none};
}

std::optional<Mat3> LoggedAttitude(const LogInputs& inputs, const logs::Row& row) {
  if (row.measured && row.measured->rpy_WS_rad)
    return Mat3(core::RotationFromRpy(logs::ToVec3(*row.measured->rpy_WS_rad)) *
                inputs.robot.R_BS.transpose());
  if (row.truth && !inputs.truth_is_of_markers)
    return core::RotationFromRpy(logs::ToVec3(row.truth->rpy_rad));
  if (row.estimate) return core::RotationFromRpy(logs::ToVec3(row.estimate->rpy_rad));
  return std::nullopt;
}

}  // namespace

LogObserver::LogObserver(const LogInputs& inputs, const controller::ControllerParams& params)
    : inputs_(inputs),
      params_(params),
      sensing_(std::in_place, controller::SensingOf(params), inputs.robot, inputs.gravity_mps2,
               inputs.period_s, controller::Placement{}, std::nullopt),
      ground_(params.reference, inputs.robot.config.nominal_height_m) {}

bool LogObserver::Step(const logs::Row& row) {
  if (!row.measured) return operating_;
  if (row.episode && logged_segment_ != row.episode->segment) {
    if (logged_segment_) BeginAnew();
    logged_segment_ = row.episode->segment;
  }
  const double dt_s = first_ ? inputs_.period_s : row.time_s - last_s_;
  const bool gap = !first_ && dt_s > kGapPeriods * inputs_.period_s;
  first_ = false;
  last_s_ = row.time_s;
  TakeSamples(row);
  plan_age_s_ += dt_s;
  if (row.plan) TakePlan(*row.plan);
  (void)sensing_->Step(z_, {plan_, plan_age_s_, ground_.plane(), operating_}, {}, counters_);
  ground_.ObserveFeet(sensing_->wb(), sensed().contact.contact,
                      inputs_.robot.legs[Leg::kFL].foot_radius_m, dt_s);
  if (operating_ && gap) GoOnAfterGap(dt_s);
  operating_ = operating_ || IsStarted(row, dt_s);
  return operating_;
}

void LogObserver::BeginAnew() {
  const core::ModelParameters known = sensing_->model().parameters();
  sensing_.emplace(controller::SensingOf(params_), inputs_.robot, inputs_.gravity_mps2,
                   inputs_.period_s, controller::Placement{}, known);
  ground_ = controller::ReferencePlanner(params_.reference, inputs_.robot.config.nominal_height_m);
  operating_ = false;
  waited_s_ = 0.0;
  first_ = true;
  ++segment_;
}

bool LogObserver::IsStarted(const logs::Row& row, double dt_s) {
  if (row.episode) return row.episode->operating;
  if (!IsWhole(inputs_, row)) return false;
  if (sensed().estimate.ready) return true;
  waited_s_ += dt_s;
  if (waited_s_ < kStartWait_s) return false;
  StartInMotion(row);
  return true;
}

void LogObserver::TakeSamples(const logs::Row& row) {
  const logs::MeasuredRow& m = *row.measured;
  ++z_.step;
  z_.imu_time_s = row.time_s;
  z_.q = OrNaN(m.q_rad);
  z_.qd = OrNaN(m.qd_radps);
  z_.tau_Nm = inputs_.torques ? OrNaN(m.tau_Nm) : ZeroPerLeg();
  z_.w_WS_S = m.w_WS_S_radps ? logs::ToVec3(*m.w_WS_S_radps) : Vec3::Constant(kNaN);
  if (inputs_.accelerometer) {
    z_.a_WS_S = m.a_WS_S_mps2 ? logs::ToVec3(*m.a_WS_S_mps2) : Vec3::Constant(kNaN);
  } else {  // as if the trunk did not accelerate
    const Mat3 R_WB = operating_ ? sensed().estimate.state.R_WB
                                 : LoggedAttitude(inputs_, row).value_or(Mat3(Mat3::Identity()));
    z_.a_WS_S = (R_WB * inputs_.robot.R_BS).transpose() * inputs_.gravity_mps2 * Vec3::UnitZ();
  }
  if (m.foot_force_counts) {
    for (const Leg leg : kLegs)
      z_.foot_force_raw[leg] = (*m.foot_force_counts)[static_cast<std::size_t>(leg)];
  }
  if (!row.truth && !row.true_contacts) return;  // the last one holds
  SensorFrame::Truth& truth = z_.truth ? *z_.truth : z_.truth.emplace();
  if (row.truth) {
    truth.state.p_WB = logs::ToVec3(row.truth->p_WB_m);
    truth.state.R_WB = core::RotationFromRpy(logs::ToVec3(row.truth->rpy_rad));
    truth.state.v_WB = logs::ToVec3(row.truth->v_WB_mps);
    truth.state.w_WB = logs::ToVec3(row.truth->w_WB_radps);
    truth.state.q = z_.q;
    truth.state.qd = z_.qd;
  }
  if (row.true_contacts) {
    for (const Leg leg : kLegs)
      truth.contact[leg] = row.true_contacts->contact[static_cast<std::size_t>(leg)];
  }
}

/// The plan of a row is that of the last tick of the planner, whenever that was; phases that stand
/// still belong to a robot that stands.
void LogObserver::TakePlan(const logs::PlanRow& row) {
  constexpr double kStanding_s = 0.03;  // three ticks of the planner
  bool same = true;
  for (const Leg leg : kLegs) {
    const auto i = static_cast<std::size_t>(leg);
    same = same && plan_.phase[leg] == row.phase[i];
    plan_.phase[leg] = row.phase[i];
    plan_.stance[leg] = row.stance[i];
    plan_.duty[leg] = row.duty;
  }
  if (!same) plan_age_s_ = 0.0;
  plan_.period_s = row.period_s;
  plan_.standing = plan_age_s_ > kStanding_s;
}

void LogObserver::StartInMotion(const logs::Row& row) {
  controller::StateEstimate from = sensed().estimate;
  from.state.R_WB = LoggedAttitude(inputs_, row).value_or(from.state.R_WB);
  from.state.w_WB = from.state.R_WB * inputs_.robot.R_BS * sensing_->last_samples().w_WS_S;
  from.gyro_bias_S.reset();
  ContinueUnsure(from);
  started_in_motion_ = true;
}

void LogObserver::GoOnAfterGap(double gap_s) {
  ContinueUnsure(sensed().estimate);
  ++gaps_;
  if (gap_s > params_.samples.max_gap_s) ++segment_;
}

/// With the velocity of the standing feet, as unsure of tilt and velocity as an estimator assumes
/// that follows one without a covariance.
void LogObserver::ContinueUnsure(controller::StateEstimate from) {
  RobotState& s = from.state;
  const SensorFrame& z = sensing_->last_samples();
  s.v_WB =
      core::CalcStanceVelocity(inputs_.robot, s.R_WB, s.w_WB, z.q, z.qd, sensed().contact.contact)
          .value_or(Vec3::Zero());
  from.P_tilt_v.setZero();
  sensing_->ContinueEstimate(from, 1.0);
}

}  // namespace scoria::app
