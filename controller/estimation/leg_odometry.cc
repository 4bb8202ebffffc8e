// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/leg_odometry.h"

#include "core/math/so3.h"
#include "core/robot/stance_velocity.h"

namespace scoria::controller {

StateEstimate LegOdometry::Update(const EstimatorInput& in, Counters&) noexcept {
  StateEstimate out;
  if (in.at_rest || !started_) {
    started_ = true;
    rest_.Add(in.z.a_WS_S, in.z.w_WS_S, in.imu_dt_s);
    gyro_bias_S_ = rest_.GyroBias_S();
    state_ = {};
    state_.R_WB = rest_.R_WB(robot_.R_BS, placement_.yaw_rad);
    state_.p_WB = StandingPlace(robot_, placement_, state_.R_WB, in.z.q);
    out.ready = !in.at_rest || rest_.IsReady();
  } else {
    const Vec3 w_WB_B = robot_.R_BS * (in.z.w_WS_S - gyro_bias_S_);
    state_.R_WB = state_.R_WB * core::ExpSo3(w_WB_B * in.imu_dt_s);
    state_.w_WB = state_.R_WB * w_WB_B;
    if (const std::optional<Vec3> v_W = core::CalcStanceVelocity(
            robot_, state_.R_WB, state_.w_WB, in.z.q, in.z.qd, in.contact.contact))
      state_.v_WB = *v_W;
    state_.p_WB += in.imu_dt_s * state_.v_WB;
  }
  out.state = state_;
  out.state.q = in.z.q;
  out.state.qd = in.z.qd;
  out.gyro_bias_S = gyro_bias_S_;
  return out;
}

void LegOdometry::Continue(const StateEstimate& from, double) noexcept {
  started_ = true;
  state_ = from.state;
  if (from.gyro_bias_S) gyro_bias_S_ = *from.gyro_bias_S;
}

}  // namespace scoria::controller
