// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace scoria::logs {

/// One instant of an episode, as analysis sees it: at the rate of the body controller, streamed by
/// the runner or read from a log (topic /scoria/row). Truth comes from the simulator. Legs FL FR HL
/// HR; vectors x y z in W unless named otherwise.
struct LogRow {
  static constexpr const char* kTypeName = "scoria_msgs/msg/Row";

  std::int64_t step = 0;
  double time_s = 0.0;

  // Truth.
  std::array<double, 3> p_WB_m{}, v_WB_mps{}, w_WB_radps{}, rpy_rad{};
  std::array<double, 12> q_rad{}, qd_radps{}, tau_Nm{};
  std::array<double, 12> p_WF_m{}, f_F_W_N{};
  double trunk_force_N = 0.0;
  double ground_z_m = 0.0;  // under the trunk
  double total_mass_kg = 0.0;
  std::array<double, 3> p_BC_m{};  // centre of mass of the whole robot, payload included, in B
  double mech_abs_J = 0.0, mech_pos_J = 0.0, electrical_J = 0.0,
         battery_J = 0.0;  // since the start

  // Energy ledger since the last placement: works on the robot, and its energy now.
  double work_motor_J = 0.0, work_joint_J = 0.0, work_contact_J = 0.0, work_external_J = 0.0;
  double kinetic_J = 0.0, potential_J = 0.0, initial_J = 0.0;

  // What was asked for and decided.
  double cmd_v_x_mps = 0.0, cmd_v_y_mps = 0.0, cmd_w_z_radps = 0.0;
  std::array<double, 3> ref_rpy_rad{}, ref_p_WC_m{}, ref_v_WC_mps{};
  double com_z_m = 0.0;  // true height of the centre of mass
  double period_s = 0.0, duty = 0.0;
  std::array<double, 4> phase{};
  std::array<bool, 4> planned_stance{};
  std::array<std::uint8_t, 4> leg_mode{};  // LegMode
  std::array<double, 12> foot_target_m{};

  // What the controller believed. The estimator's frame starts at the place where the robot was
  // put.
  std::array<double, 3> est_p_WB_m{}, est_v_WB_mps{}, est_rpy_rad{};
  double nees = 0.0;  // of roll, pitch and body velocity, 5 degrees of freedom; 0: none
  double nis = 0.0;   // of the last correction by the feet; 0: none
  std::uint32_t nis_dof = 0;
  std::array<double, 12> est_f_F_W_N{};
  std::array<bool, 4> true_contact{}, contact{};  // truly; the word that counted
  std::array<std::uint8_t, 4> contact_source{};   // ContactSource of it
  std::array<bool, 4> contact_sensor{}, contact_observer{}, sensor_healthy{};
  std::array<double, 4> sensor_counts{};         // over the threshold
  std::array<double, 4> observer_probability{};  // of contact

  // What the controller believes of its mass: learned, and acted on. Zero without adaptation.
  double learned_mass_kg = 0.0, used_mass_kg = 0.0, learned_sigma_kg = 0.0;
  std::array<double, 3> learned_p_BC_m{};
  bool learned_tared = false;

  // What the stages say of themselves, 1 as designed to 0 of no use, and which of them the
  // supervisor has given up: MPC, body controller, estimator, contact, footing, load.
  std::array<double, 6> stage_quality{};
  std::array<bool, 6> fallen_back{};

  bool operating = false;     // the walking controller is in charge
  bool fallen = false;        // from the fall until the robot is set on its feet and walks again
  std::uint32_t segment = 0;  // counts placements: rows of different segments are not one path

  template <class Archive>
  void Serialize(Archive& a) {
    a("step", step);
    a("time_s", time_s);
    a("p_WB_m", p_WB_m);
    a("v_WB_mps", v_WB_mps);
    a("w_WB_radps", w_WB_radps);
    a("rpy_rad", rpy_rad);
    a("q_rad", q_rad);
    a("qd_radps", qd_radps);
    a("tau_Nm", tau_Nm);
    a("p_WF_m", p_WF_m);
    a("f_F_W_N", f_F_W_N);
    a("trunk_force_N", trunk_force_N);
    a("ground_z_m", ground_z_m);
    a("total_mass_kg", total_mass_kg);
    a("p_BC_m", p_BC_m);
    a("mech_abs_J", mech_abs_J);
    a("mech_pos_J", mech_pos_J);
    a("electrical_J", electrical_J);
    a("battery_J", battery_J);
    a("work_motor_J", work_motor_J);
    a("work_joint_J", work_joint_J);
    a("work_contact_J", work_contact_J);
    a("work_external_J", work_external_J);
    a("kinetic_J", kinetic_J);
    a("potential_J", potential_J);
    a("initial_J", initial_J);
    a("cmd_v_x_mps", cmd_v_x_mps);
    a("cmd_v_y_mps", cmd_v_y_mps);
    a("cmd_w_z_radps", cmd_w_z_radps);
    a("ref_rpy_rad", ref_rpy_rad);
    a("ref_p_WC_m", ref_p_WC_m);
    a("ref_v_WC_mps", ref_v_WC_mps);
    a("com_z_m", com_z_m);
    a("period_s", period_s);
    a("duty", duty);
    a("phase", phase);
    a("planned_stance", planned_stance);
    a("leg_mode", leg_mode);
    a("foot_target_m", foot_target_m);
    a("est_p_WB_m", est_p_WB_m);
    a("est_v_WB_mps", est_v_WB_mps);
    a("est_rpy_rad", est_rpy_rad);
    a("nees", nees);
    a("nis", nis);
    a("nis_dof", nis_dof);
    a("est_f_F_W_N", est_f_F_W_N);
    a("true_contact", true_contact);
    a("contact", contact);
    a("contact_source", contact_source);
    a("contact_sensor", contact_sensor);
    a("contact_observer", contact_observer);
    a("sensor_healthy", sensor_healthy);
    a("sensor_counts", sensor_counts);
    a("observer_probability", observer_probability);
    a("learned_mass_kg", learned_mass_kg);
    a("used_mass_kg", used_mass_kg);
    a("learned_sigma_kg", learned_sigma_kg);
    a("learned_p_BC_m", learned_p_BC_m);
    a("learned_tared", learned_tared);
    a("stage_quality", stage_quality);
    a("fallen_back", fallen_back);
    a("operating", operating);
    a("fallen", fallen);
    a("segment", segment);
  }
};

/// Wall-clock times of the solvers in one row's tick; zero where none ran. Kept apart from LogRow,
/// which is reproducible.
struct SolveTimes {
  double mpc_s = 0.0, wbc_s = 0.0;
};

}  // namespace scoria::logs
