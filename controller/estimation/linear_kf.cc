// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/linear_kf.h"

#include "core/math/so3.h"

namespace scoria::controller {
namespace {

constexpr int kPosition = 0, kVelocity = 1;
constexpr int FootRow(Leg leg) noexcept { return 2 + static_cast<int>(leg); }

}  // namespace

LinearKf::LinearKf(const LinearKfParams& params, const core::RobotDescription& robot,
                   double gravity_mps2, const Placement& placement) noexcept
    : params_(params),
      robot_(robot),
      gravity_mps2_(gravity_mps2),
      placement_(placement),
      rest_(params.rest) {}

StateEstimate LinearKf::Update(const EstimatorInput& in, Counters&) noexcept {
  if (in.at_rest || !started_) {
    rest_.Add(in.z.a_WS_S, in.z.w_WS_S, in.imu_dt_s);
    RobotState at_rest;
    at_rest.R_WB = rest_.R_WB(robot_.R_BS, placement_.yaw_rad);
    at_rest.p_WB = StandingPlace(robot_, placement_, at_rest.R_WB, in.z.q);
    at_rest.q = in.z.q;
    gyro_bias_S_ = rest_.GyroBias_S();
    Start(at_rest);
  } else {
    Turn(in);
    Predict(in);
    Correct(in);
  }
  StateEstimate out;
  out.ready = !in.at_rest || rest_.IsReady();
  out.state.R_WB = R_WB_;
  out.state.p_WB = x_.row(kPosition).transpose();
  out.state.v_WB = x_.row(kVelocity).transpose();
  out.state.w_WB = R_WB_ * w_WB_B_;
  out.state.q = in.z.q;
  out.state.qd = in.z.qd;
  out.gyro_bias_S = gyro_bias_S_;
  return out;
}

void LinearKf::Start(const RobotState& state) noexcept {
  started_ = true;
  R_WB_ = state.R_WB;
  x_.row(kPosition) = state.p_WB.transpose();
  x_.row(kVelocity) = state.v_WB.transpose();
  constexpr double kStartVelocity_mps = 0.01;
  P_.setZero();
  P_(kVelocity, kVelocity) = kStartVelocity_mps * kStartVelocity_mps;
  for (const Leg leg : kLegs) {
    const Vec3 p_BF = core::CalcLegKinematics(robot_.legs[leg], state.q[leg]).p_BF;
    x_.row(FootRow(leg)) = x_.row(kPosition) + (R_WB_ * p_BF).transpose();
    P_(FootRow(leg), FootRow(leg)) = params_.foot_position_m * params_.foot_position_m;
  }
}

void LinearKf::Continue(const StateEstimate& from, double) noexcept {
  if (from.gyro_bias_S) gyro_bias_S_ = *from.gyro_bias_S;
  Start(from.state);
}

/// Source: [Mahony2008], passive complementary filter with bias, gravity only.
void LinearKf::Turn(const EstimatorInput& in) noexcept {
  const Vec3 up_measured_B = (robot_.R_BS * in.z.a_WS_S).normalized();
  const Vec3 up_B = R_WB_.transpose() * Vec3::UnitZ();
  const Vec3 error_B = up_measured_B.cross(up_B);
  gyro_bias_S_ -= params_.bias_gain_radps2 * in.imu_dt_s * (robot_.R_BS.transpose() * error_B);
  w_WB_B_ = robot_.R_BS * (in.z.w_WS_S - gyro_bias_S_);
  R_WB_ = R_WB_ * core::ExpSo3((w_WB_B_ + params_.attitude_gain_radps * error_B) * in.imu_dt_s);
}

void LinearKf::Predict(const EstimatorInput& in) noexcept {
  const double dt = in.imu_dt_s;
  if (dt == 0.0) return;
  const Vec3 w_B = w_WB_B_, p_BS = robot_.p_BS;
  const Vec3 a_WB_B = robot_.R_BS * in.z.a_WS_S - w_B.cross(w_B.cross(p_BS));
  const Vec3 a_W = R_WB_ * a_WB_B - Vec3(0.0, 0.0, gravity_mps2_);
  x_.row(kPosition) += dt * x_.row(kVelocity) + 0.5 * dt * dt * a_W.transpose();
  x_.row(kVelocity) += dt * a_W.transpose();
  P_.row(kPosition) += dt * P_.row(kVelocity);
  P_.col(kPosition) += dt * P_.col(kVelocity);
  const double accel = params_.accel_mps_per_sqrts;
  P_(kVelocity, kVelocity) += accel * accel * dt;
  for (const Leg leg : kLegs) {
    const double creep =
        in.contact.contact[leg] ? params_.foot_slip_m_per_sqrts : params_.foot_air_m_per_sqrts;
    P_(FootRow(leg), FootRow(leg)) += creep * creep * dt;
  }
}

void LinearKf::Correct(const EstimatorInput& in) noexcept {
  for (const Leg leg : kLegs) {
    const core::LegKinematics foot = core::CalcLegKinematics(robot_.legs[leg], in.z.q[leg]);
    Row place = Row::Zero();
    place(kPosition) = -1.0;
    place(FootRow(leg)) = 1.0;
    CorrectBy(place, R_WB_ * foot.p_BF, params_.foot_position_m);
    if (!in.contact.contact[leg]) continue;
    Row still = Row::Zero();
    still(kVelocity) = 1.0;
    const Vec3 v_BF_B = w_WB_B_.cross(foot.p_BF) + foot.J * in.z.qd[leg];
    CorrectBy(still, -(R_WB_ * v_BF_B), params_.foot_velocity_mps);
  }
}

void LinearKf::CorrectBy(const Row& h, const Vec3& measured_W, double sigma) noexcept {
  const Vec6 Ph = P_ * h.transpose();
  const double s = h.dot(Ph) + sigma * sigma;
  const Vec6 k = Ph / s;
  x_ += k * (measured_W.transpose() - h * x_);
  P_ -= k * Ph.transpose();
  P_ = 0.5 * (P_ + P_.transpose()).eval();
}

}  // namespace scoria::controller
