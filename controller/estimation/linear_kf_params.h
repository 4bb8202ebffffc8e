// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/estimation/rest_attitude.h"
#include "core/config/field.h"

namespace scoria::controller {

/// The usual baseline: attitude by a complementary filter, position and velocity by a linear Kalman
/// filter over trunk and feet. Source: [Bledt2018a], [Mahony2008].
struct LinearKfParams {
  static constexpr const char* kType = "linear_kf";
  double attitude_gain_radps = 0.1, bias_gain_radps2 = 0.01;
  double accel_mps_per_sqrts = 0.02;
  double foot_slip_m_per_sqrts = 0.01, foot_air_m_per_sqrts = 10.0;
  double foot_position_m = 0.003, foot_velocity_mps = 0.1;
  RestParams rest;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("attitude_gain_radps", attitude_gain_radps,
            {.min = 0.0, .max = 10.0, .doc = "of the measured gravity's pull on the attitude"});
    a.Field("bias_gain_radps2", bias_gain_radps2, {.min = 0.0, .max = 10.0});
    a.Field("accel_mps_per_sqrts", accel_mps_per_sqrts, {.min = 0.0, .max = 10.0});
    a.Field("foot_slip_m_per_sqrts", foot_slip_m_per_sqrts,
            {.min = 0.0,
             .max = 10.0,
             .scale = core::dimension::kLength / core::Pow(core::dimension::kTime, 0.5)});
    a.Field("foot_air_m_per_sqrts", foot_air_m_per_sqrts,
            {.min = 0.0,
             .max = 1e3,
             .doc = "how far a foot in the air moves",
             .scale = core::dimension::kLength / core::Pow(core::dimension::kTime, 0.5)});
    a.Field("foot_position_m", foot_position_m,
            {.min = 1e-5, .max = 1.0, .scale = core::dimension::kLength});
    a.Field("foot_velocity_mps", foot_velocity_mps,
            {.min = 1e-5, .max = 10.0, .scale = core::dimension::kSpeed});
    a.Field("rest", rest);
  }
  bool operator==(const LinearKfParams&) const = default;
};

}  // namespace scoria::controller
