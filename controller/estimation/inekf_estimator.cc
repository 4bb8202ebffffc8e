// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/inekf_estimator.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>

#include "core/math/so3.h"

namespace scoria::controller {
namespace {

constexpr std::array<int, 5> kTiltAndVelocity = {InekfIndex::kRotation, InekfIndex::kRotation + 1,
                                                 InekfIndex::kVelocity, InekfIndex::kVelocity + 1,
                                                 InekfIndex::kVelocity + 2};

Mat3 Isotropic(double sigma) noexcept { return sigma * sigma * Mat3::Identity(); }

InekfNoise MakeNoise(const InekfEstimatorParams& p, double imu_scale) noexcept {
  return {Isotropic(imu_scale * p.gyro_rad_per_sqrts), Isotropic(imu_scale * p.accel_mps_per_sqrts),
          Isotropic(p.gyro_walk_radps_per_sqrts), Isotropic(p.accel_walk_mps2_per_sqrts),
          Isotropic(p.foot_slip_m_per_sqrts)};
}

/// Covariance at rest. The tilt comes from the accelerometer, so its error is that of the
/// accelerometer's unknown bias: ξ_tilt = z × R ζ_a / g, next to a small one of its own.
InekfCovariance CalcStartCovariance(const InekfEstimatorParams& p, const Mat3& R_WS,
                                    double gravity_mps2) noexcept {
  using I = InekfIndex;
  constexpr double kStartVelocity_mps = 0.01, kKnown = 1e-6;
  InekfCovariance P = InekfCovariance::Zero();
  const Mat3 accel_bias = Isotropic(p.start_accel_bias_mps2);
  const Mat3 tilt_by_bias = core::Skew(Vec3::UnitZ()) * R_WS / gravity_mps2;
  P.block<3, 3>(I::kRotation, I::kRotation) =
      tilt_by_bias * accel_bias * tilt_by_bias.transpose() + Isotropic(p.start_tilt_rad);
  P(I::kRotation + 2, I::kRotation + 2) = kKnown * kKnown;  // the heading is told
  P.block<3, 3>(I::kRotation, I::kAccelBias) = tilt_by_bias * accel_bias;
  P.block<3, 3>(I::kAccelBias, I::kRotation) =
      P.block<3, 3>(I::kRotation, I::kAccelBias).transpose();
  P.block<3, 3>(I::kVelocity, I::kVelocity) = Isotropic(kStartVelocity_mps);
  P.block<3, 3>(I::kPosition, I::kPosition) = Isotropic(kKnown);
  P.block<3, 3>(I::kGyroBias, I::kGyroBias) = Isotropic(p.start_gyro_bias_radps);
  P.block<3, 3>(I::kAccelBias, I::kAccelBias) = accel_bias;
  return P;
}

}  // namespace

InekfEstimator::InekfEstimator(const InekfEstimatorParams& params,
                               const core::RobotDescription& robot, double gravity_mps2,
                               const Placement& placement) noexcept
    : params_(params),
      robot_(robot),
      gravity_mps2_(gravity_mps2),
      placement_(placement),
      rest_(params.rest),
      filter_({MakeNoise(params, 1.0), Vec3(0.0, 0.0, -gravity_mps2), InekfModel::kExact}) {}

StateEstimate InekfEstimator::Update(const EstimatorInput& in, Counters& counters) noexcept {
  if (in.at_rest || !started_) {
    rest_.Add(in.z.a_WS_S, in.z.w_WS_S, in.imu_dt_s);
    Start(in.z);
    StateEstimate out = Describe(in.z);
    out.ready = rest_.IsReady();
    return out;
  }
  Predict(in, counters);
  MoveFeet(in);
  const InekfCorrection correction = Correct(in, counters);
  StateEstimate out = Describe(in.z);
  out.nis = correction.nis;
  out.nis_dof = correction.dof;
  return out;
}

void InekfEstimator::Start(const SensorFrame& z) noexcept {
  started_ = true;
  InekfState x;
  const Mat3 R_WB = rest_.R_WB(robot_.R_BS, placement_.yaw_rad);
  x.R_WS = R_WB * robot_.R_BS;
  x.p_WS = StandingPlace(robot_, placement_, R_WB, z.q) + R_WB * robot_.p_BS;
  x.gyro_bias_S = rest_.GyroBias_S();
  w_WS_S_ = Vec3::Zero();
  filter_.Set(x, CalcStartCovariance(params_, x.R_WS, gravity_mps2_));
}

void InekfEstimator::Continue(const StateEstimate& from, double sigma_scale) noexcept {
  using I = InekfIndex;
  constexpr double kVelocity_mps = 0.05;
  // Of an estimator that states no covariance, as the complementary filter of linear_kf.
  constexpr double kUnstatedTilt_rad = 0.03, kUnstatedVelocity_mps = 0.1, kUnstatedBias = 5.0;
  const RobotState& s = from.state;
  InekfState x;
  x.R_WS = s.R_WB * robot_.R_BS;
  const Vec3 p_BS_W = s.R_WB * robot_.p_BS;
  x.p_WS = s.p_WB + p_BS_W;
  x.v_WS = s.v_WB + s.w_WB.cross(p_BS_W);
  if (from.gyro_bias_S) x.gyro_bias_S = *from.gyro_bias_S;
  InekfEstimatorParams unsure = params_;
  unsure.start_tilt_rad *= sigma_scale;
  unsure.start_gyro_bias_radps *= sigma_scale * (from.gyro_bias_S ? 1.0 : kUnstatedBias);
  unsure.start_accel_bias_mps2 *= sigma_scale;
  InekfCovariance P = CalcStartCovariance(unsure, x.R_WS, gravity_mps2_);
  P.block<3, 3>(I::kVelocity, I::kVelocity) = Isotropic(sigma_scale * kVelocity_mps);
  StateEstimate::Mat5 stated = from.P_tilt_v;
  if (stated.isZero()) {
    stated.topLeftCorner<2, 2>() = Isotropic(kUnstatedTilt_rad).topLeftCorner<2, 2>();
    stated.bottomRightCorner<3, 3>() = Isotropic(kUnstatedVelocity_mps);
  }
  P(kTiltAndVelocity, kTiltAndVelocity) += stated;
  filter_.Set(x, P);
  started_ = true;
}

void InekfEstimator::Predict(const EstimatorInput& in, Counters& counters) noexcept {
  w_WS_S_ = in.z.w_WS_S - filter_.state().gyro_bias_S;
  if (in.imu_dt_s == 0.0) return;
  if (in.imu_saturated) filter_.set_noise(MakeNoise(params_, params_.saturated_scale));
  if (filter_.Predict(in.z.a_WS_S, in.z.w_WS_S, in.imu_dt_s) != InekfStatus::kOk)
    counters.Add(Count::kEstimateRefused);
  if (in.imu_saturated) filter_.set_noise(MakeNoise(params_, 1.0));
}

/// A sphere that rolls without slip moves its centre by w × r n. On soft ground it sinks by an
/// unknown share of what it may: after it touched, and under a load that changes by Δf. The rates
/// below add fresh_sink² in all, and (c Δf)² for a sudden change.
void InekfEstimator::MoveFeet(const EstimatorInput& in) noexcept {
  const double dt_s = in.imu_dt_s, tau_s = params_.load_change_s;
  const Mat3 along_normal_W = in.n_W * in.n_W.transpose();
  const Mat3 sink_shape_W = along_normal_W + params_.sink_aside * params_.sink_aside *
                                                 (Mat3::Identity() - along_normal_W);
  for (const Leg leg : kLegs) {
    const Vec3 contact_to_centre_W = robot_.legs[leg].foot_radius_m * in.n_W;
    const Vec3 roll_W = params_.model_rolling
                            ? Vec3(dt_s * in.wb.w_shank_W[leg].cross(contact_to_centre_W))
                            : Vec3(Vec3::Zero());
    const Vec3 change_W = in.contact.f_F_W[leg] - mean_f_F_W_[leg];
    mean_f_F_W_[leg] += dt_s / (dt_s + tau_s) * change_W;
    const double sink_m = params_.foot_compliance_m_per_N * in.n_W.dot(change_W);
    const double fresh_m = params_.fresh_sink_m * std::exp(-touching_s_[leg] / params_.fresh_s);
    const double variance_m2 =
        2.0 * dt_s * (sink_m * sink_m / tau_s + fresh_m * fresh_m / params_.fresh_s);
    filter_.MoveFoot(leg, roll_W, variance_m2 * sink_shape_W);
  }
}

InekfCorrection InekfEstimator::Correct(const EstimatorInput& in, Counters& counters) noexcept {
  LegArray<FootMeasurement> feet;
  const Mat3 R_SB = robot_.R_BS.transpose();
  for (const Leg leg : kLegs) {
    const Vec3 p_BF = core::CalcLegKinematics(robot_.legs[leg], in.z.q[leg]).p_BF;
    touching_s_[leg] = in.contact.contact[leg] ? touching_s_[leg] + in.imu_dt_s : 0.0;
    feet[leg] = {touching_s_[leg] > params_.impact_s, R_SB * (p_BF - robot_.p_BS),
                 Isotropic(params_.foot_position_m)};
  }
  LiftSlippedFeet(feet, in.imu_dt_s, counters);
  InekfCorrection correction = filter_.Correct(feet);
  if (correction.status != InekfStatus::kOk) counters.Add(Count::kEstimateRefused);
  return correction;
}

/// A foot whose mean innovation is far beyond what the filter expects has moved on the ground: it
/// leaves the state, and enters it anew where it is.
void InekfEstimator::LiftSlippedFeet(const LegArray<FootMeasurement>& feet, double dt_s,
                                     Counters& counters) noexcept {
  const double gain = std::min(1.0, dt_s / params_.slip_window_s);
  for (const Leg leg : kLegs) {
    const FootInnovation innovation = filter_.CalcInnovation(leg, feet[leg]);
    Vec3& mean_W = mean_innovation_W_[leg];
    if (!innovation.used) {
      mean_W.setZero();
      continue;
    }
    mean_W += gain * (innovation.y_W - mean_W);
    if (mean_W.dot(innovation.cov_W.llt().solve(mean_W)) < params_.slip_nis) continue;
    filter_.Drop(leg);
    mean_W.setZero();
    counters.Add(Count::kSlip);
  }
}

StateEstimate InekfEstimator::Describe(const SensorFrame& z) const noexcept {
  const InekfState& x = filter_.state();
  StateEstimate out;
  RobotState& s = out.state;
  s.R_WB = x.R_WS * robot_.R_BS.transpose();
  s.w_WB = x.R_WS * w_WS_S_;
  const Vec3 p_BS_W = s.R_WB * robot_.p_BS;
  s.p_WB = x.p_WS - p_BS_W;
  s.v_WB = x.v_WS - s.w_WB.cross(p_BS_W);
  s.q = z.q;
  s.qd = z.qd;
  out.P_tilt_v = filter_.covariance()(kTiltAndVelocity, kTiltAndVelocity);
  out.gyro_bias_S = x.gyro_bias_S;
  return out;
}

}  // namespace scoria::controller
