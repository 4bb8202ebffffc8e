// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/estimation/rest_attitude.h"
#include "core/config/field.h"

namespace scoria::controller {

/// Contact-aided right-invariant Kalman filter with IMU biases. Source: [Hartley2020].
struct InekfEstimatorParams {
  static constexpr const char* kType = "inekf";
  double gyro_rad_per_sqrts = 2.5e-4, gyro_walk_radps_per_sqrts = 2e-5;
  double accel_mps_per_sqrts = 5e-3, accel_walk_mps2_per_sqrts = 2e-4;
  double foot_slip_m_per_sqrts = 0.01;
  double foot_position_m = 0.003;
  double impact_s = 0.02;
  double fresh_sink_m = 0.02, fresh_s = 0.12;
  double foot_compliance_m_per_N = 3e-4, load_change_s = 0.02;
  double sink_aside = 0.5;
  double start_tilt_rad = 3e-3, start_gyro_bias_radps = 1e-3, start_accel_bias_mps2 = 0.03;
  double slip_nis = 16.0, slip_window_s = 0.02;
  double saturated_scale = 100.0;
  bool model_rolling = true;
  RestParams rest;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("gyro_rad_per_sqrts", gyro_rad_per_sqrts,
            {.min = 0.0, .max = 1.0, .doc = "density of the gyroscope's white noise"});
    a.Field("gyro_walk_radps_per_sqrts", gyro_walk_radps_per_sqrts, {.min = 0.0, .max = 1.0});
    a.Field("accel_mps_per_sqrts", accel_mps_per_sqrts,
            {.min = 0.0, .max = 10.0, .doc = "density of the accelerometer's white noise"});
    a.Field("accel_walk_mps2_per_sqrts", accel_walk_mps2_per_sqrts, {.min = 0.0, .max = 10.0});
    a.Field("foot_slip_m_per_sqrts", foot_slip_m_per_sqrts,
            {.min = 0.0,
             .max = 10.0,
             .doc = "how far a standing foot creeps",
             .scale = core::dimension::kLength / core::Pow(core::dimension::kTime, 0.5)});
    a.Field("foot_position_m", foot_position_m,
            {.min = 1e-5,
             .max = 1.0,
             .doc = "error of a foot's place by the joint angles",
             .scale = core::dimension::kLength});
    a.Field("impact_s", impact_s,
            {.min = 0.0,
             .max = 1.0,
             .doc = "a foot is used so long after it touched",
             .scale = core::dimension::kTime});
    a.Field("fresh_sink_m", fresh_sink_m,
            {.min = 0.0,
             .max = 1.0,
             .doc = "how far a foot may sink after it touched",
             .scale = core::dimension::kLength});
    a.Field("fresh_s", fresh_s,
            {.min = 1e-3,
             .max = 10.0,
             .doc = "time constant with which that ends",
             .scale = core::dimension::kTime});
    a.Field("foot_compliance_m_per_N", foot_compliance_m_per_N,
            {.min = 0.0,
             .max = 0.1,
             .doc = "how far a foot may sink into soft ground per change of its load",
             .scale = core::dimension::kLength / core::dimension::kForce});
    a.Field("load_change_s", load_change_s,
            {.min = 1e-3,
             .max = 1.0,
             .doc = "over which a change of load counts as one",
             .scale = core::dimension::kTime});
    a.Field("sink_aside", sink_aside,
            {.min = 0.0, .max = 1.0, .doc = "share of a sinking foot's motion along the ground"});
    a.Field("rest", rest);
    a.Field("start_tilt_rad", start_tilt_rad,
            {.min = 0.0, .max = 1.0, .doc = "error of the first attitude beyond that of the bias"});
    a.Field("start_gyro_bias_radps", start_gyro_bias_radps, {.min = 0.0, .max = 1.0});
    a.Field("start_accel_bias_mps2", start_accel_bias_mps2, {.min = 0.0, .max = 10.0});
    a.Field("slip_nis", slip_nis,
            {.min = 0.0,
             .max = 1e6,
             .doc = "a foot whose innovation, averaged over slip_window_s, exceeds this (squared, "
                    "normalised, 3 degrees of freedom) has slipped and is set down anew"});
    a.Field("slip_window_s", slip_window_s,
            {.min = 0.001, .max = 1.0, .scale = core::dimension::kTime});
    a.Field("saturated_scale", saturated_scale,
            {.min = 1.0, .max = 1e6, .doc = "of the IMU's noise while it saturates"});
    a.Field("model_rolling", model_rolling, {.doc = "the round foot rolls on the ground"});
  }
  bool operator==(const InekfEstimatorParams&) const = default;
};

}  // namespace scoria::controller
