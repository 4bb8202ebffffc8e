// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>
#include <string>
#include <variant>

#include "core/config/archive.h"

namespace scoria::sim {

/// How often a sensor samples and how long a sample is on its way; whole physics steps.
struct SamplingParams {
  double rate_Hz = 1000.0;
  double latency_s = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("rate_Hz", rate_Hz,
            {.min = 1.0, .max = 1e4, .doc = "at most one sample in a physics step"});
    a.Field("latency_s", latency_s, {.min = 0.0, .max = 0.1, .doc = "from sample to controller"});
  }
};

/// Inertial unit. Densities are one-sided and per axis: a sample has the noise density √rate, and a
/// bias has moved by walk √t after t. Defaults are those of a calibrated MEMS unit.
struct ImuParams {
  SamplingParams sampling;
  double gyro_noise_radps_per_sqrt_Hz = 1.7e-4;
  double gyro_bias_radps = 2e-3;
  double gyro_walk_radps2_per_sqrt_Hz = 1e-5;
  double gyro_limit_radps = 34.9;  // 2000 deg/s
  double accel_noise_mps2_per_sqrt_Hz = 2e-3;
  double accel_bias_mps2 = 0.03;
  double accel_walk_mps3_per_sqrt_Hz = 1e-4;
  double accel_limit_mps2 = 157.0;  // 16 g
  double scale_error = 1e-3;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("sampling", sampling);
    a.Field("gyro_noise_radps_per_sqrt_Hz", gyro_noise_radps_per_sqrt_Hz,
            {.min = 0.0, .max = 0.1, .doc = "density of the white noise"});
    a.Field("gyro_bias_radps", gyro_bias_radps,
            {.min = 0.0, .max = 1.0, .doc = "standard deviation at turn-on"});
    a.Field("gyro_walk_radps2_per_sqrt_Hz", gyro_walk_radps2_per_sqrt_Hz,
            {.min = 0.0, .max = 0.1, .doc = "density of the bias's random walk"});
    a.Field("gyro_limit_radps", gyro_limit_radps, {.min = 1.0, .max = 1e3, .doc = "saturation"});
    a.Field("accel_noise_mps2_per_sqrt_Hz", accel_noise_mps2_per_sqrt_Hz,
            {.min = 0.0, .max = 1.0, .doc = "density of the white noise"});
    a.Field("accel_bias_mps2", accel_bias_mps2,
            {.min = 0.0, .max = 5.0, .doc = "standard deviation at turn-on"});
    a.Field("accel_walk_mps3_per_sqrt_Hz", accel_walk_mps3_per_sqrt_Hz,
            {.min = 0.0, .max = 1.0, .doc = "density of the bias's random walk"});
    a.Field("accel_limit_mps2", accel_limit_mps2, {.min = 15.0, .max = 1e4, .doc = "saturation"});
    a.Field("scale_error", scale_error,
            {.min = 0.0, .max = 0.1, .doc = "standard deviation per axis, gyro and accelerometer"});
  }
};

/// Joint encoders with the velocity that the drive computes from them.
struct EncoderParams {
  SamplingParams sampling;
  int bits = 14;
  double velocity_bandwidth_Hz = 125.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("sampling", sampling);
    a.Field("bits", bits, {.min = 0, .max = 30, .doc = "per turn of the joint; 0: not quantised"});
    a.Field("velocity_bandwidth_Hz", velocity_bandwidth_Hz,
            {.min = 0.0,
             .max = 1e4,
             .doc = "natural frequency f of the tracking loop, whose velocity lags by 1/(pi f); 0: "
                    "the true velocity"});
  }
};

/// Motor torque from its current.
struct TorqueSensorParams {
  SamplingParams sampling{.rate_Hz = 1000.0, .latency_s = 0.002};
  double gain_error = 0.02;
  double offset_Nm = 0.1;
  double noise_Nm = 0.15;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("sampling", sampling);
    a.Field("gain_error", gain_error,
            {.min = 0.0, .max = 0.5, .doc = "standard deviation per joint"});
    a.Field("offset_Nm", offset_Nm,
            {.min = 0.0,
             .max = 10.0,
             .doc = "standard deviation per joint",
             .scale = core::dimension::kTorque});
    a.Field("noise_Nm", noise_Nm,
            {.min = 0.0,
             .max = 10.0,
             .doc = "standard deviation per sample",
             .scale = core::dimension::kTorque});
  }
};

/// Foot force as raw counts of the firmware, in the manner of the Go2.
struct FootForceParams {
  SamplingParams sampling{.rate_Hz = 500.0, .latency_s = 0.002};
  double gain_per_N = 1.0;
  double gain_spread = 0.15;
  double dead_band_N = 5.0;
  double zero_min = 5.0, zero_max = 15.0;
  double drift_per_sqrt_s = 0.2;
  double limit = 1023.0;
  double resolution = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("sampling", sampling);
    a.Field("gain_per_N", gain_per_N,
            {.min = 1e-3,
             .max = 1e3,
             .doc = "counts, of the median foot",
             .scale = core::Pow(core::dimension::kForce, -1.0)});
    a.Field("gain_spread", gain_spread,
            {.min = 0.0, .max = 1.0, .doc = "standard deviation of a foot's ln(gain)"});
    a.Field(
        "dead_band_N", dead_band_N,
        {.min = 0.0, .max = 100.0, .doc = "force that reads 0", .scale = core::dimension::kForce});
    a.Field("zero_min", zero_min, {.min = 0.0, .max = 1e4, .doc = "least counts of a free foot"});
    a.Field("zero_max", zero_max, {.min = 0.0, .max = 1e4, .doc = "most counts of a free foot"});
    a.Field("drift_per_sqrt_s", drift_per_sqrt_s,
            {.min = 0.0, .max = 100.0, .doc = "counts, random walk of the zero level"});
    a.Field("limit", limit, {.min = 1.0, .max = 1e6, .doc = "greatest counts; the least are 0"});
    a.Field("resolution", resolution,
            {.min = 0.0, .max = 100.0, .doc = "counts of a step; 0: not quantised"});
  }
  [[nodiscard]] std::string Problem() const {
    return zero_min <= zero_max ? "" : "zero_min must not exceed zero_max";
  }
};

/// Sensors as a robot has them.
struct RealisticSensors {
  static constexpr const char* kType = "realistic";
  static constexpr const char* kFormerType = "honest";
  ImuParams imu;
  EncoderParams encoders;
  TorqueSensorParams torque;
  FootForceParams foot_force;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("imu", imu);
    a.Field("encoders", encoders);
    a.Field("torque", torque);
    a.Field("foot_force", foot_force);
  }
};

/// Sensors that read the truth of every physics step at once; feet in N.
struct IdealSensors {
  static constexpr const char* kType = "ideal";
  template <class Archive>
  void Serialize(Archive&) {}
};

using SensorParams = std::variant<RealisticSensors, IdealSensors>;

/// What makes realistic sensors ideal: no errors, no limits, a sample in every step.
[[nodiscard]] inline RealisticSensors WithoutErrors() noexcept {
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  constexpr SamplingParams kEveryStep{.rate_Hz = kUnlimited, .latency_s = 0.0};
  RealisticSensors p;
  p.imu = {kEveryStep, 0.0, 0.0, 0.0, kUnlimited, 0.0, 0.0, 0.0, kUnlimited, 0.0};
  p.encoders = {kEveryStep, 0, 0.0};
  p.torque = {kEveryStep, 0.0, 0.0, 0.0};
  p.foot_force = {kEveryStep, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, kUnlimited, 0.0};
  return p;
}

}  // namespace scoria::sim
