// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/rows.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

#include "app/episode/arrays.h"
#include "core/math/so3.h"
#include "sim/sensors/sensors.h"

namespace scoria::app {
namespace {

/// Normalised error squared of tilt and velocity; zero without a covariance. The velocity's error
/// is right-invariant, so it is that of the body velocity, turned into W.
double CalcNees(const RobotState& truth, const controller::StateEstimate& estimate) {
  if (estimate.P_tilt_v.isZero()) return 0.0;
  const Mat3 R_error = estimate.state.R_WB * truth.R_WB.transpose();
  Eigen::Matrix<double, 5, 1> error;
  error << core::LogSo3(R_error).head<2>(), estimate.state.v_WB - R_error * truth.v_WB;
  return error.dot(estimate.P_tilt_v.ldlt().solve(error));
}

}  // namespace

void FillEstimate(const controller::ControlOutput& control, const RobotState& truth,
                  logs::LogRow& row) {
  const controller::StateEstimate& e = control.estimate;
  row.est_p_WB_m = ToArray(e.state.p_WB);
  row.est_v_WB_mps = ToArray(e.state.v_WB);
  row.est_rpy_rad = ToArray(core::RpyFromRotation(e.state.R_WB));
  row.nees = CalcNees(truth, e);
  row.nis = e.nis;
  row.nis_dof = static_cast<std::uint32_t>(e.nis_dof);
  const ContactEstimate& c = control.contact;
  row.est_f_F_W_N = Flatten(c.f_F_W);
  row.contact = ToArray(c.contact);
  for (const Leg leg : kLegs) {
    row.contact_source[static_cast<std::size_t>(leg)] = static_cast<std::uint8_t>(c.source[leg]);
  }
  row.contact_sensor = ToArray(c.sensor);
  row.contact_observer = ToArray(c.observer);
  row.sensor_healthy = ToArray(c.sensor_healthy);
  row.sensor_counts = ToArray(c.sensor_counts);
  row.observer_probability = ToArray(c.observer_probability);
  row.learned_mass_kg = control.adaptation.mass_kg;
  row.used_mass_kg = control.model_mass_kg;
  row.learned_sigma_kg = std::sqrt(control.adaptation.P(0, 0));
  row.learned_p_BC_m = ToArray(control.adaptation.p_BC);
  row.learned_tared = control.adaptation.tared;
}

logs::SolveTimes SolveTimesOf(const controller::ControlOutput& control) {
  return {control.mpc_updated ? control.mpc_solve_s : 0.0,
          control.wbc_updated ? control.wbc_solve_s : 0.0};
}

logs::LogRow MakeRow(const StepRecord& r) {
  logs::LogRow row;
  const RobotState& s = r.truth.state;
  row.step = r.step;
  row.time_s = r.time_s;
  row.p_WB_m = ToArray(s.p_WB);
  row.v_WB_mps = ToArray(s.v_WB);
  row.w_WB_radps = ToArray(s.w_WB);
  row.rpy_rad = ToArray(core::RpyFromRotation(s.R_WB));
  row.q_rad = Flatten(s.q);
  row.qd_radps = Flatten(s.qd);
  row.tau_Nm = Flatten(r.motor_tau_Nm);
  row.p_WF_m = Flatten(r.truth.p_WF);
  row.f_F_W_N = Flatten(r.truth.f_F_W);
  row.trunk_force_N = r.truth.trunk_force_N;
  row.ground_z_m = r.ground_z_m;
  row.total_mass_kg = r.truth.mass_kg;
  row.mech_abs_J = r.energy.mech_abs_J;
  row.mech_pos_J = r.energy.mech_pos_J;
  row.electrical_J = r.energy.electrical_J;
  row.battery_J = r.battery.delivered_J;
  const sim::EnergyLedger& ledger = r.truth.energy;
  row.work_motor_J = ledger.work.motor_J;
  row.work_joint_J = ledger.work.joint_J;
  row.work_contact_J = ledger.work.contact_J;
  row.work_external_J = ledger.work.external_J;
  row.kinetic_J = ledger.kinetic_J;
  row.potential_J = ledger.potential_J;
  row.initial_J = ledger.initial_J;
  row.cmd_v_x_mps = r.command.v_x_mps;
  row.cmd_v_y_mps = r.command.v_y_mps;
  row.cmd_w_z_radps = r.command.w_z_radps;
  row.com_z_m = r.truth.p_WC.z();
  row.p_BC_m = ToArray(s.R_WB.transpose() * (r.truth.p_WC - s.p_WB));
  const controller::ControlOutput& c = r.control;
  row.ref_rpy_rad = ToArray(c.reference.rpy_rad);
  row.ref_p_WC_m = ToArray(c.reference.p_WC);
  row.ref_v_WC_mps = ToArray(c.reference.v_WC);
  row.period_s = c.contacts.period_s;
  row.duty = c.contacts.duty[Leg::kFL];
  row.phase = ToArray(c.contacts.phase);
  row.planned_stance = ToArray(c.contacts.stance);
  FillEstimate(c, s, row);
  LegArray<Vec3> targets = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    const auto i = static_cast<std::size_t>(leg);
    row.leg_mode[i] = static_cast<std::uint8_t>(c.legs.mode[leg]);
    row.true_contact[i] = r.truth.f_normal_N[leg] > sim::kTrueContactForce_N;
    targets[leg] = c.feet[leg].p_WF;
  }
  row.foot_target_m = Flatten(targets);
  row.stage_quality = c.qualities;
  row.fallen_back = c.fallen_back;
  row.operating = c.operating;
  row.fallen = r.fallen;
  row.segment = r.segment;
  return row;
}

}  // namespace scoria::app
