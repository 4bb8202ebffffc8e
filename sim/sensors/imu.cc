// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensors/imu.h"

#include <cmath>
#include <limits>

namespace scoria::sim {
namespace {

Vec6 Join(double gyro, double accel) noexcept {
  Vec6 v;
  v << Vec3::Constant(gyro), Vec3::Constant(accel);
  return v;
}

Vec3 Saturate(const Vec3& v, double limit) noexcept {
  return v.cwiseMax(Vec3::Constant(-limit)).cwiseMin(Vec3::Constant(limit));
}

}  // namespace

Imu::Imu(const core::RobotDescription& robot, const ImuParams& params, const Vec3& gravity_W,
         double step_s, std::uint64_t seed)
    : robot_(robot),
      params_(params),
      gravity_W_(gravity_W),
      step_s_(step_s),
      noise_(seed, 0, core::Stream::kImu),
      loss_(seed, 0, core::Stream::kSensorFault),
      clock_(SampleClock(params.sampling, step_s)),
      delay_(Latency<Sample>(params.sampling, step_s)),
      scale_(Vec6::Ones() + params.scale_error * DrawNormals<6>(noise_)),
      bias_(Join(params.gyro_bias_radps, params.accel_bias_mps2)
                .cwiseProduct(DrawNormals<6>(noise_))),
      noise_sigma_(Join(params.gyro_noise_radps_per_sqrt_Hz, params.accel_noise_mps2_per_sqrt_Hz) /
                   std::sqrt(clock_.interval_s())),
      walk_sigma_(Join(params.gyro_walk_radps2_per_sqrt_Hz, params.accel_walk_mps3_per_sqrt_Hz) *
                  std::sqrt(clock_.interval_s())) {}

void Imu::Reset() noexcept {
  clock_.Reset();
  delay_.Clear();
  has_velocity_ = false;
  sum_a_S_ = sum_w_S_ = Vec3::Zero();
  summed_ = 0;
}

void Imu::Accumulate(const RobotState& s) noexcept {
  const Vec3 v_WS = s.v_WB + s.w_WB.cross(s.R_WB * robot_.p_BS);
  const Vec3 a_WS = has_velocity_ ? Vec3((v_WS - v_WS_) / step_s_) : Vec3::Zero();
  v_WS_ = v_WS;
  has_velocity_ = true;
  const Mat3 R_WS = s.R_WB * robot_.R_BS;
  sum_a_S_ += R_WS.transpose() * (a_WS - gravity_W_);
  sum_w_S_ += R_WS.transpose() * s.w_WB;
  ++summed_;
}

Imu::Sample Imu::Measure(double time_s, const ImuFault& fault) noexcept {
  bias_ += walk_sigma_.cwiseProduct(DrawNormals<6>(noise_));
  const Vec6 error = bias_ + noise_sigma_.cwiseProduct(DrawNormals<6>(noise_));
  const double n = summed_;
  const Vec3 w_S = scale_.head<3>().cwiseProduct(sum_w_S_ / n) + error.head<3>();
  const Vec3 a_S = scale_.tail<3>().cwiseProduct(sum_a_S_ / n) + error.tail<3>();
  sum_a_S_ = sum_w_S_ = Vec3::Zero();
  summed_ = 0;
  Sample sample{time_s, Saturate(a_S + fault.accel_bias_mps2, params_.accel_limit_mps2),
                Saturate(w_S + fault.gyro_bias_radps, params_.gyro_limit_radps)};
  if (fault.not_a_number)
    sample.a_WS_S = sample.w_WS_S = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  return sample;
}

const Imu::Sample& Imu::Read(const RobotState& state, std::int64_t step,
                             const ImuFault& fault) noexcept {
  Accumulate(state);
  if (clock_.Tick()) {
    const Sample sample = Measure(static_cast<double>(step) * step_s_, fault);
    const bool is_lost = fault.lost_share > 0.0 && loss_.NextUniform() < fault.lost_share;
    if (!is_lost) newest_ = sample;
  }
  return delay_.Pass(newest_);
}

}  // namespace scoria::sim
