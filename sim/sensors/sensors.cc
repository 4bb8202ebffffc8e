// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensors/sensors.h"

namespace scoria::sim {

Sensors::Sensors(const core::RobotDescription& robot, const Vec3& gravity_W, double step_s)
    : robot_(robot), gravity_W_(gravity_W), step_s_(step_s) {}

SensorFrame Sensors::Read(const Truth& truth, const LegArray<Vec3>& motor_tau_Nm, std::int64_t step,
                          bool give_truth) noexcept {
  const RobotState& s = truth.state;
  SensorFrame z;
  z.step = step;
  z.q = s.q;
  z.qd = s.qd;
  z.tau_Nm = motor_tau_Nm;
  const Vec3 v_WS = s.v_WB + s.w_WB.cross(s.R_WB * robot_.p_BS);
  const Vec3 a_WS = has_velocity_ ? Vec3((v_WS - v_WS_) / step_s_) : Vec3::Zero();
  v_WS_ = v_WS;
  has_velocity_ = true;
  const Mat3 R_WS = s.R_WB * robot_.R_BS;
  z.a_WS_S = R_WS.transpose() * (a_WS - gravity_W_);
  z.w_WS_S = R_WS.transpose() * s.w_WB;
  SensorFrame::Truth given;
  given.state = s;
  for (const Leg leg : kLegs) {
    z.foot_force_N[leg] = robot_.config.has_foot_sensors ? truth.f_normal_N[leg] : 0.0;
    given.contact[leg] = truth.f_normal_N[leg] > kTrueContactForce_N;
  }
  if (give_truth) z.truth = given;
  return z;
}

}  // namespace scoria::sim
