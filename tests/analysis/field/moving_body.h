// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/math/types.h"
#include "logs/row.h"

namespace scoria::test {

/// A trunk that walks and turns by a formula, seen by an IMU, and by motion capture of markers that
/// are late and elsewhere.
struct MovingBody {
  double duration_s = 40.0, rate_Hz = 250.0;
  double speed_mps = 0.5, turning_radps = 0.4, sway_rad = 0.04;
  double delay_s = 0.0;
  Vec3 p_BM = Vec3::Zero();
  Mat3 R_BM = Mat3::Identity();
  /// Errors of gyroscope, accelerometer, and of place and attitude of the truth.
  double gyro_noise_radps = 0.01, accelerometer_noise_mps2 = 0.1, place_noise_m = 3e-4,
         attitude_noise_rad = 1e-3;
  Vec3 gyro_bias_radps = {0.01, -0.02, 0.015}, accelerometer_bias_mps2 = {0.2, -0.1, 0.15};
  std::uint64_t seed = 1;

  [[nodiscard]] Mat3 R_WB(double t_s) const;
  [[nodiscard]] Vec3 p_WB(double t_s) const;
  /// IMU at the origin of B, estimate exact but for a yaw of 0.5 rad and a drift of 3 cm/s.
  [[nodiscard]] std::vector<logs::Row> Rows() const;
};

}  // namespace scoria::test
