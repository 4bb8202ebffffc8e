// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/contact_estimator.h"

#include <cmath>

namespace scoria::controller {
namespace {

template <class T>
LegArray<T> OnePerLeg(const T& value) noexcept {
  return {value, value, value, value};
}

}  // namespace

bool NeedsTruth(const ContactParams& params) noexcept {
  return params.source == ContactChoice::kTruth;
}

ContactEstimator::ContactEstimator(const ContactParams& params, const core::RobotDescription& robot,
                                   double gravity_mps2, double step_s) noexcept
    : params_(params),
      has_sensors_(robot.config.has_foot_sensors),
      gravity_mps2_(gravity_mps2),
      step_s_(step_s),
      delay_steps_(std::lround(params.touchdown_delay_s / step_s)),
      observer_(params.observer, robot, gravity_mps2),
      sensors_(OnePerLeg(FootSensor(params.sensor, step_s))),
      health_(OnePerLeg(SensorHealth(params.health, step_s))) {}

void ContactEstimator::UpdateObserver(const ContactInput& in) noexcept {
  out_.f_F_W = observer_.Update({in.wb, in.z, step_s_});
  out_.vd_WB = observer_.a_B().head<3>();
  out_.wd_WB = observer_.a_B().tail<3>();
  const Vec3 n_W = in.plane.Normal();
  const double weight_N = in.wb.mass_kg * gravity_mps2_;
  for (const Leg leg : kLegs) {
    force_N_[leg] = n_W.dot(out_.f_F_W[leg]);
    const PlannedPhase planned = AdvancePhase(in.plan, leg, in.plan_age_s);
    const double over_plane_m =
        n_W.z() * (in.wb.p_WF[leg].z() - in.plane.Height(in.wb.p_WF[leg])) - in.foot_radius_m;
    out_.observer_probability[leg] = CalcContactProbability(
        params_.fusion,
        {planned.phase, planned.duty, in.plan.period_s, force_N_[leg] / weight_N, over_plane_m});
    out_.observer[leg] =
        DecideContact(params_.fusion, out_.observer_probability[leg], out_.observer[leg]);
  }
}

void ContactEstimator::UpdateSensors(const ContactInput& in) noexcept {
  if (!has_sensors_) return;
  for (const Leg leg : kLegs) {
    const double raw = in.z.foot_force_raw[leg];
    const bool up =
        !out_.observer[leg] && out_.observer_probability[leg] < 1.0 - params_.health.sure;
    unloaded_s_[leg] = up ? unloaded_s_[leg] + step_s_ : 0.0;
    out_.sensor[leg] = sensors_[leg].Update(raw, unloaded_s_[leg] > params_.health.transition_s);
    out_.sensor_counts[leg] = raw - sensors_[leg].threshold_counts();
    out_.sensor_healthy[leg] = health_[leg].Update(
        {raw, out_.sensor[leg], out_.observer[leg], out_.observer_probability[leg], force_N_[leg],
         in.wb.v_WF[leg].norm(), sensors_[leg].zero_counts()});
  }
}

void ContactEstimator::UpdateTruth(const SensorFrame& z) noexcept {
  if (!z.truth) return;
  for (const Leg leg : kLegs) {
    touching_steps_[leg] = z.truth->contact[leg] ? touching_steps_[leg] + 1 : 0;
    truth_[leg] = touching_steps_[leg] > delay_steps_;
  }
}

ContactSource ContactEstimator::Choose(Leg leg) const noexcept {
  switch (params_.source) {
    case ContactChoice::kTruth:
      return ContactSource::kTruth;
    case ContactChoice::kGaitPhase:
      return ContactSource::kGaitPhase;
    case ContactChoice::kMomentumObserver:
      return ContactSource::kObserver;
    case ContactChoice::kSensor:
      return has_sensors_ ? ContactSource::kSensor : ContactSource::kObserver;
    case ContactChoice::kHierarchy:
      break;
  }
  return out_.sensor_healthy[leg] ? ContactSource::kSensor : ContactSource::kObserver;
}

bool ContactEstimator::Word(ContactSource source, Leg leg, const ContactInput& in) const noexcept {
  switch (source) {
    case ContactSource::kTruth:
      return truth_[leg];
    case ContactSource::kGaitPhase:
      return AdvancePhase(in.plan, leg, in.plan_age_s).IsStance();
    case ContactSource::kSensor:
      return out_.sensor[leg];
    case ContactSource::kObserver:
      break;
  }
  return out_.observer[leg];
}

ContactEstimate ContactEstimator::Update(const ContactInput& in) noexcept {
  UpdateObserver(in);
  UpdateSensors(in);
  UpdateTruth(in.z);
  for (const Leg leg : kLegs) {
    out_.source[leg] = Choose(leg);
    out_.contact[leg] = Word(out_.source[leg], leg, in);
  }
  return out_;
}

}  // namespace scoria::controller
