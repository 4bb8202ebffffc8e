// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "core/robot/legs.h"

namespace scoria {

/// Floating-base configuration and velocity. All vectors in W; B is the URDF base link.
struct RobotState {
  Vec3 p_WB = Vec3::Zero();  // m
  Mat3 R_WB = Mat3::Identity();
  Vec3 v_WB = Vec3::Zero();          // m/s, of B's origin
  Vec3 w_WB = Vec3::Zero();          // rad/s
  LegArray<Vec3> q = ZeroPerLeg();   // rad
  LegArray<Vec3> qd = ZeroPerLeg();  // rad/s
  bool operator==(const RobotState&) const = default;
};

/// What the sensors have said by one physics step: the newest sample of each. `truth` is set only
/// where the scenario asks for a stage of type `truth`.
struct SensorFrame {
  struct Truth {
    RobotState state;
    LegArray<bool> contact;
    bool operator==(const Truth&) const = default;
  };
  std::int64_t step = 0;
  double imu_time_s = 0.0;               // stamp of the IMU sample, the end of its interval
  LegArray<Vec3> q = ZeroPerLeg();       // rad, encoders
  LegArray<Vec3> qd = ZeroPerLeg();      // rad/s, as the drive computes it
  LegArray<Vec3> tau_Nm = ZeroPerLeg();  // motor torque, from its current
  Vec3 a_WS_S = Vec3::Zero();            // m/s^2, specific force: +g upward at rest
  Vec3 w_WS_S = Vec3::Zero();            // rad/s
  LegArray<double> foot_force_raw;       // counts of the firmware; 0 without foot sensors
  std::optional<Truth> truth;
  bool operator==(const SensorFrame&) const = default;
};

/// What each motor is asked for: tau = tau_ff + kp (q - q_meas) + kd (qd - qd_meas), evaluated
/// every physics step.
struct JointCommand {
  LegArray<Vec3> q = ZeroPerLeg();       // rad
  LegArray<Vec3> qd = ZeroPerLeg();      // rad/s
  LegArray<Vec3> tau_Nm = ZeroPerLeg();  // feed-forward
  LegArray<Vec3> kp_Nm_per_rad = ZeroPerLeg();
  LegArray<Vec3> kd_Nms_per_rad = ZeroPerLeg();
  bool operator==(const JointCommand&) const = default;
};

/// In which order the feet go, where the operator asks for one: diagonal pairs, one after the
/// other, or the pairs of a side.
enum class GaitPattern { kOwn, kTrot, kWalk, kPace };
constexpr std::array<std::pair<GaitPattern, std::string_view>, 4> EnumNames(GaitPattern) {
  return {{{GaitPattern::kOwn, "own"},
           {GaitPattern::kTrot, "trot"},
           {GaitPattern::kWalk, "walk"},
           {GaitPattern::kPace, "pace"}}};
}

/// What the operator asks for, in the heading frame H.
struct Command {
  double v_x_mps = 0.0, v_y_mps = 0.0;
  double w_z_radps = 0.0;
  double height_m = 0.0;  // COM over the ground; 0 means the robot's nominal height
  double roll_rad = 0.0, pitch_rad = 0.0;
  GaitPattern pattern = GaitPattern::kOwn;
  [[nodiscard]] bool IsStop() const noexcept {
    return v_x_mps == 0.0 && v_y_mps == 0.0 && w_z_radps == 0.0;
  }
  bool operator==(const Command&) const = default;
};

}  // namespace scoria
