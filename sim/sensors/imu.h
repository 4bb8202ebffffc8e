// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/rng.h"
#include "core/robot/description.h"
#include "core/robot/state.h"
#include "sim/sensors/faults.h"
#include "sim/sensors/sampling.h"

namespace scoria::sim {

/// Inertial unit at S. A sample is the mean over the interval that ends at its stamp, so that
/// integrating samples loses nothing, whatever the rate.
class Imu {
 public:
  struct Sample {
    double time_s = 0.0;         // end of the interval
    Vec3 a_WS_S = Vec3::Zero();  // m/s^2, specific force
    Vec3 w_WS_S = Vec3::Zero();  // rad/s
  };

  /// Draws biases and scales of this turn-on. `robot` is borrowed.
  Imu(const core::RobotDescription& robot, const ImuParams& params, const Vec3& gravity_W,
      double step_s, std::uint64_t seed);

  /// One physics step. @returns the newest sample that has arrived.
  [[nodiscard]] const Sample& Read(const RobotState& state, std::int64_t step,
                                   const ImuFault& fault) noexcept;

  /// The robot was placed: forgets its velocity and samples on their way; biases stay.
  void Reset() noexcept;

 private:
  void Accumulate(const RobotState& state) noexcept;
  [[nodiscard]] Sample Measure(double time_s, const ImuFault& fault) noexcept;

  const core::RobotDescription& robot_;
  ImuParams params_;
  Vec3 gravity_W_;
  double step_s_;
  core::Rng noise_, loss_;
  core::RateDivider clock_;
  core::DelayLine<Sample> delay_;
  // Gyro, then accelerometer.
  Vec6 scale_, bias_, noise_sigma_, walk_sigma_;
  Sample newest_;
  Vec3 v_WS_ = Vec3::Zero();
  bool has_velocity_ = false;
  Vec3 sum_a_S_ = Vec3::Zero(), sum_w_S_ = Vec3::Zero();  // since the last sample
  int summed_ = 0;
};

}  // namespace scoria::sim
