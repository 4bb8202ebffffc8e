// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "logs/messages/ros.h"

/// Messages of the log. `interfaces/*` are the reference framework's definitions, field by field,
/// so that simulated and field logs read alike; `scoria_msgs/*` are ours. Legs FL FR HL HR, joints
/// HAA HFE KFE, quaternions x y z w.
namespace scoria::logs::msg {

struct JointState {
  static constexpr const char* kTypeName = "interfaces/msg/JointState";
  Header header;
  std::array<double, 12> position{}, velocity{}, effort{}, acceleration{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("position", position);
    a("velocity", velocity);
    a("effort", effort);
    a("acceleration", acceleration);
  }
};

struct JointCmd {
  static constexpr const char* kTypeName = "interfaces/msg/JointCmd";
  Header header;
  std::array<double, 12> position{}, velocity{}, effort{}, kp{}, kd{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("position", position);
    a("velocity", velocity);
    a("effort", effort);
    a("kp", kp);
    a("kd", kd);
  }
};

/// Twist and acceleration in world axes; ground_contact_force in W (the reference's estimator
/// writes body axes, its simulator world). We fill the acceleration from the IMU, without gravity
/// and with the accelerometer's bias; the accelerations of the joints stay 0, and belly_contact
/// false: nothing estimates them.
struct QuadState {
  static constexpr const char* kTypeName = "interfaces/msg/QuadState";
  Header header;
  PoseWithCovariance pose;
  TwistWithCovariance twist;
  Accel acceleration;
  JointState joint_state;
  std::array<bool, 4> foot_contact{};
  std::array<double, 12> ground_contact_force{};
  bool belly_contact = false;
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("pose", pose);
    a("twist", twist);
    a("acceleration", acceleration);
    a("joint_state", joint_state);
    a("foot_contact", foot_contact);
    a("ground_contact_force", ground_contact_force);
    a("belly_contact", belly_contact);
  }
};

struct ContactState {
  static constexpr const char* kTypeName = "interfaces/msg/ContactState";
  Header header;
  std::array<double, 4> ground_contact_force{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("ground_contact_force", ground_contact_force);
  }
};

struct QuadControlTarget {
  static constexpr const char* kTypeName = "interfaces/msg/QuadControlTarget";
  double body_x_dot = 0.0, body_y_dot = 0.0, world_z = 0.0, hybrid_theta_dot = 0.0, pitch = 0.0,
         roll = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("body_x_dot", body_x_dot);
    a("body_y_dot", body_y_dot);
    a("world_z", world_z);
    a("hybrid_theta_dot", hybrid_theta_dot);
    a("pitch", pitch);
    a("roll", roll);
  }
};

struct GaitState {
  static constexpr const char* kTypeName = "interfaces/msg/GaitState";
  double period = 0.0;
  std::array<double, 4> duty_factor{}, phase_offset{};
  std::array<bool, 4> contact{};
  std::array<double, 4> phase{};
  std::uint8_t gait_sequencer = 0;  // 0 simple, 1 adaptive
  template <class Archive>
  void Serialize(Archive& a) {
    a("period", period);
    a("duty_factor", duty_factor);
    a("phase_offset", phase_offset);
    a("contact", contact);
    a("phase", phase);
    a("gait_sequencer", gait_sequencer);
  }
};

struct WBCTarget {
  static constexpr const char* kTypeName = "interfaces/msg/WBCTarget";
  Header header;
  Pose pose;
  Twist twist;
  std::array<bool, 4> feet_contacts{};
  std::array<Vector3, 4> feet_pos_targets{}, feet_vel_targets{}, feet_acc_targets{},
      feet_wrenches{};
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("pose", pose);
    a("twist", twist);
    a("feet_contacts", feet_contacts);
    a("feet_pos_targets", feet_pos_targets);
    a("feet_vel_targets", feet_vel_targets);
    a("feet_acc_targets", feet_acc_targets);
    a("feet_wrenches", feet_wrenches);
  }
};

struct MPCDiagnostics {
  static constexpr const char* kTypeName = "interfaces/msg/MPCDiagnostics";
  Header header;
  double solve_time = 0.0, acados_solve_qp_time = 0.0, acados_condensing_time = 0.0,
         acados_interface_time = 0.0, acados_total_time = 0.0;
  std::int64_t acados_num_iter = 0, acados_t_computed = 0, acados_return = 0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("solve_time", solve_time);
    a("acados_solve_qp_time", acados_solve_qp_time);
    a("acados_condensing_time", acados_condensing_time);
    a("acados_interface_time", acados_interface_time);
    a("acados_total_time", acados_total_time);
    a("acados_num_iter", acados_num_iter);
    a("acados_t_computed", acados_t_computed);
    a("acados_return", acados_return);
  }
};

struct WBCReturn {
  static constexpr const char* kTypeName = "interfaces/msg/WBCReturn";
  Header header;
  bool success = false;
  double total_time = 0.0, qp_update_time = 0.0, qp_solve_time = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("success", success);
    a("total_time", total_time);
    a("qp_update_time", qp_update_time);
    a("qp_solve_time", qp_solve_time);
  }
};

struct ControllerInfo {
  static constexpr const char* kTypeName = "interfaces/msg/ControllerInfo";
  Header header;
  std::uint32_t num_early_contacts = 0, num_mpc_solver_overtime = 0, num_wbc_overtime = 0,
                num_mpc_solver_fail = 0, num_wbc_solver_fail = 0, num_model_updates = 0;
  bool keep_pose_active = false;
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("num_early_contacts", num_early_contacts);
    a("num_mpc_solver_overtime", num_mpc_solver_overtime);
    a("num_wbc_overtime", num_wbc_overtime);
    a("num_mpc_solver_fail", num_mpc_solver_fail);
    a("num_wbc_solver_fail", num_wbc_solver_fail);
    a("num_model_updates", num_model_updates);
    a("keep_pose_active", keep_pose_active);
  }
};

struct QuadModel {
  static constexpr const char* kTypeName = "interfaces/msg/QuadModel";
  Header header;
  double mass = 0.0;
  std::array<double, 3> com{};
  std::array<double, 9> inertia{};  // column major
  template <class Archive>
  void Serialize(Archive& a) {
    a("header", header);
    a("mass", mass);
    a("com", com);
    a("inertia", inertia);
  }
};

struct BatteryState {
  static constexpr const char* kTypeName = "interfaces/msg/BatteryState";
  float voltage = 0.0f, current = 0.0f;
  template <class Archive>
  void Serialize(Archive& a) {
    a("voltage", voltage);
    a("current", current);
  }
};

/// FNV-1a over the bits of the true state, every hundred physics steps.
struct StateHash {
  static constexpr const char* kTypeName = "scoria_msgs/msg/StateHash";
  std::int64_t step = 0;
  std::uint64_t hash = 0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("step", step);
    a("hash", hash);
  }
};

/// A controller was started: where and how the operator put the robot down.
struct ControllerStart {
  static constexpr const char* kTypeName = "scoria_msgs/msg/ControllerStart";
  std::int64_t step = 0;
  bool standing = false;
  double x_m = 0.0, y_m = 0.0, ground_z_m = 0.0, yaw_rad = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a("step", step);
    a("standing", standing);
    a("x_m", x_m);
    a("y_m", y_m);
    a("ground_z_m", ground_z_m);
    a("yaw_rad", yaw_rad);
  }
};

/// Everything that the controller was told in one physics step, exactly as it came: a replay of it
/// gives the same estimates bit for bit.
struct ControllerInput {
  static constexpr const char* kTypeName = "scoria_msgs/msg/ControllerInput";
  std::int64_t step = 0;
  double imu_time_s = 0.0;
  std::array<double, 12> q_rad{}, qd_radps{}, tau_nm{};
  std::array<double, 3> specific_force_mps2{}, rate_radps{};
  std::array<double, 4> foot_force_raw{};
  double v_x_mps = 0.0, v_y_mps = 0.0, w_z_radps = 0.0, height_m = 0.0, roll_rad = 0.0,
         pitch_rad = 0.0;
  std::uint8_t pattern = 0;
  std::uint8_t mpc_fault = 0, wbc_fault = 0;  // SolverFault that was played
  template <class Archive>
  void Serialize(Archive& a) {
    a("step", step);
    a("imu_time_s", imu_time_s);
    a("q_rad", q_rad);
    a("qd_radps", qd_radps);
    a("tau_nm", tau_nm);
    a("specific_force_mps2", specific_force_mps2);
    a("rate_radps", rate_radps);
    a("foot_force_raw", foot_force_raw);
    a("v_x_mps", v_x_mps);
    a("v_y_mps", v_y_mps);
    a("w_z_radps", w_z_radps);
    a("height_m", height_m);
    a("roll_rad", roll_rad);
    a("pitch_rad", pitch_rad);
    a("pattern", pattern);
    a("mpc_fault", mpc_fault);
    a("wbc_fault", wbc_fault);
  }
};

struct Event {
  static constexpr const char* kTypeName = "scoria_msgs/msg/Event";
  std::int64_t step = 0;
  std::string kind, detail;
  template <class Archive>
  void Serialize(Archive& a) {
    a("step", step);
    a("kind", kind);
    a("detail", detail);
  }
};

}  // namespace scoria::logs::msg
