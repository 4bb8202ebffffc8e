// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/rows.h"

#include <cmath>

#include "app/episode/arrays.h"
#include "core/math/so3.h"
#include "sim/sensors/sensors.h"

namespace scoria::app {
namespace {

logs::TruthRow MakeTruth(const StepRecord& r) {
  const RobotState& s = r.truth.state;
  logs::TruthRow row;
  row.p_WB_m = ToArray(s.p_WB);
  row.v_WB_mps = ToArray(s.v_WB);
  row.w_WB_radps = ToArray(s.w_WB);
  row.rpy_rad = ToArray(core::RpyFromRotation(s.R_WB));
  row.ground_z_m = r.ground_z_m;
  return row;
}

logs::TrueContactsRow MakeTrueContacts(const sim::Truth& truth) {
  logs::TrueContactsRow row;
  row.p_WF_m = Flatten(truth.p_WF);
  row.f_F_W_N = Flatten(truth.f_F_W);
  for (const Leg leg : kLegs) {
    row.contact[static_cast<std::size_t>(leg)] = truth.contact[leg];
  }
  row.trunk_force_N = truth.trunk_force_N;
  return row;
}

logs::TrueMassRow MakeTrueMass(const sim::Truth& truth) {
  const RobotState& s = truth.state;
  return {truth.mass_kg, ToArray(s.R_WB.transpose() * (truth.p_WC - s.p_WB)), truth.p_WC.z()};
}

logs::LedgerRow MakeLedger(const sim::EnergyLedger& ledger) {
  return {ledger.work.motor_J, ledger.work.joint_J, ledger.work.contact_J, ledger.work.external_J,
          ledger.kinetic_J,    ledger.potential_J,  ledger.initial_J};
}

logs::MeasuredRow MakeMeasured(const StepRecord& r) {
  const SensorFrame& z = r.sensors;
  logs::MeasuredRow row;
  row.q_rad = Flatten(z.q);
  row.qd_radps = Flatten(z.qd);
  row.tau_Nm = Flatten(z.tau_Nm);
  row.a_WS_S_mps2 = ToArray(z.a_WS_S);
  row.w_WS_S_radps = ToArray(z.w_WS_S);
  if (r.has_foot_sensors) row.foot_force_counts = ToArray(z.foot_force_raw);
  row.battery_V = r.battery.voltage_V;
  row.battery_A = r.battery.current_A;
  return row;
}

logs::PlanRow MakePlan(const controller::ControlOutput& c) {
  logs::PlanRow row;
  row.period_s = c.contacts.period_s;
  row.duty = c.contacts.duty[Leg::kFL];
  row.phase = ToArray(c.contacts.phase);
  row.stance = ToArray(c.contacts.stance);
  row.leg_mode.emplace();
  LegArray<Vec3> targets = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    (*row.leg_mode)[static_cast<std::size_t>(leg)] = static_cast<std::uint8_t>(c.legs.mode[leg]);
    targets[leg] = c.feet[leg].p_WF;
  }
  row.foot_target_m = Flatten(targets);
  return row;
}

logs::EstimateRow MakeEstimate(const controller::StateEstimate& e) {
  logs::EstimateRow row;
  row.p_WB_m = ToArray(e.state.p_WB);
  row.v_WB_mps = ToArray(e.state.v_WB);
  row.rpy_rad = ToArray(core::RpyFromRotation(e.state.R_WB));
  if (!e.P_tilt_v.isZero()) {
    auto out = row.P_tilt_v.emplace().begin();
    for (int i = 0; i < e.P_tilt_v.rows(); ++i) {
      for (int j = 0; j <= i; ++j) *out++ = e.P_tilt_v(i, j);
    }
  }
  if (e.nis_dof > 0) row.innovation = {e.nis, static_cast<std::uint32_t>(e.nis_dof)};
  return row;
}

logs::ContactsRow MakeContacts(const ContactEstimate& c, bool has_foot_sensors) {
  logs::ContactsRow row;
  row.contact = ToArray(c.contact);
  row.source.emplace();
  for (const Leg leg : kLegs)
    (*row.source)[static_cast<std::size_t>(leg)] = static_cast<std::uint8_t>(c.source[leg]);
  row.f_F_W_N = Flatten(c.f_F_W);
  if (has_foot_sensors)
    row.sensor = {ToArray(c.sensor), ToArray(c.sensor_healthy), ToArray(c.sensor_counts)};
  row.observer = {ToArray(c.observer), ToArray(c.observer_probability)};
  return row;
}

logs::ModelRow MakeModel(const controller::Adaptation& learned, double used_mass_kg) {
  logs::ModelRow row;
  row.used_mass_kg = used_mass_kg;
  if (learned.mass_kg > 0.0)
    row.learned = {learned.mass_kg, std::sqrt(learned.P(0, 0)), ToArray(learned.p_BC),
                   learned.tared};
  return row;
}

}  // namespace

void FillSensed(const controller::Sensed& sensed, double used_mass_kg, bool has_foot_sensors,
                logs::Row& row) {
  row.estimate = MakeEstimate(sensed.estimate);
  row.contacts = MakeContacts(sensed.contact, has_foot_sensors);
  row.model = MakeModel(sensed.adaptation, used_mass_kg);
}

void FillControl(const controller::ControlOutput& control, bool has_foot_sensors, logs::Row& row) {
  row.plan = MakePlan(control);
  row.reference = {ToArray(control.reference.rpy_rad), ToArray(control.reference.p_WC),
                   ToArray(control.reference.v_WC)};
  FillSensed(control, control.model_mass_kg, has_foot_sensors, row);
  row.supervision = {control.qualities, control.fallen_back};
}

logs::Row MakeRow(const StepRecord& r) {
  logs::Row row;
  row.time_s = r.time_s;
  row.episode = {r.step, r.control.operating, r.fallen, r.segment};
  row.truth = MakeTruth(r);
  row.true_joints = {Flatten(r.truth.state.q), Flatten(r.truth.state.qd), Flatten(r.motor_tau_Nm)};
  row.true_contacts = MakeTrueContacts(r.truth);
  row.true_mass = MakeTrueMass(r.truth);
  row.energy = {r.energy.mech_abs_J, r.energy.mech_pos_J, r.energy.electrical_J,
                r.battery.delivered_J};
  row.ledger = MakeLedger(r.truth.energy);
  row.measured = MakeMeasured(r);
  row.command = {r.command.v_x_mps, r.command.v_y_mps, r.command.w_z_radps};
  FillControl(r.control, r.has_foot_sensors, row);
  row.solve_times.emplace();
  if (r.control.mpc_updated) row.solve_times->mpc_s = r.control.mpc_solve_s;
  if (r.control.wbc_updated) row.solve_times->wbc_s = r.control.wbc_solve_s;
  return row;
}

}  // namespace scoria::app
