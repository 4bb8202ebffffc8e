// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/robot/state.h"
#include "sim/sensors/faults.h"
#include "sim/sensors/sampling.h"

namespace scoria::sim {

/// Tracking loop of type 2, critically damped, as drives use it for velocity:
///   θ̂' = ω̂ + 2 ω_n (θ − θ̂),   ω̂' = ω_n² (θ − θ̂),
/// so ω̂ = ω_n² / (s + ω_n)² of the true velocity, which lags by 2/ω_n. Drives run it at 10 kHz and
/// more, far above the physics step; so it is integrated exactly between steps, with the angle
/// linear in between. White quantisation of variance q²/12 then gives a velocity noise of at most
/// q √(ω_n³ T / 48): the 0.04 rad/s of 14 bit and 125 Hz at T = 1 ms.
class TrackingLoop {
 public:
  struct State {
    double input_rad = 0.0, angle_rad = 0.0, velocity_radps = 0.0;
  };
  TrackingLoop(double bandwidth_Hz, double step_s) noexcept;

  [[nodiscard]] State Advance(const State& state, double input_rad) const noexcept;

 private:
  double step_s_;
  Eigen::Matrix2d decay_;  // of the deviation from the ramp, in a step
};

/// Absolute encoders at the joints, quantised, and the drives' velocities.
class Encoders {
 public:
  struct Sample {
    LegArray<Vec3> q = ZeroPerLeg(), qd = ZeroPerLeg();
  };

  /// Draws where in a quantum each encoder's zero is.
  Encoders(const EncoderParams& params, double step_s, std::uint64_t seed);

  /// One physics step. @returns the newest sample that has arrived.
  [[nodiscard]] const Sample& Read(const RobotState& state,
                                   const LegArray<EncoderFault>& faults) noexcept;

  /// The robot was placed: tracking starts anew, at rest.
  void Reset() noexcept;

 private:
  [[nodiscard]] double Quantise(double q_rad, double phase_rad) const noexcept;

  double quantum_rad_;  // 0: none
  bool tracks_;
  core::RateDivider clock_;
  core::DelayLine<Sample> delay_;
  TrackingLoop loop_;
  LegArray<Vec3> phase_rad_ = ZeroPerLeg();
  LegArray<std::array<TrackingLoop::State, kJointsPerLeg>> tracked_;
  bool is_tracking_ = false;
  Sample newest_;
};

}  // namespace scoria::sim
