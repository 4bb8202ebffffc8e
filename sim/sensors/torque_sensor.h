// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/robot/state.h"
#include "sim/sensors/faults.h"
#include "sim/sensors/sampling.h"

namespace scoria::sim {

/// Torques that drives derive from their currents: of the motor's field, so blind to what friction
/// and rotor inertia take before the joint.
class TorqueSensor {
 public:
  /// Draws gains and offsets of this turn-on.
  TorqueSensor(const TorqueSensorParams& params, double step_s, std::uint64_t seed);

  /// One physics step. @returns the newest sample that has arrived, N m.
  [[nodiscard]] const LegArray<Vec3>& Read(const LegArray<Vec3>& motor_tau_Nm,
                                           const LegArray<TorqueFault>& faults) noexcept;

  /// The robot was placed: forgets samples on their way; gains and offsets stay.
  void Reset() noexcept;

 private:
  double noise_Nm_;
  core::Rng noise_;
  core::RateDivider clock_;
  core::DelayLine<LegArray<Vec3>> delay_;
  LegArray<Vec3> gain_ = ZeroPerLeg(), offset_Nm_ = ZeroPerLeg();
  LegArray<Vec3> newest_Nm_ = ZeroPerLeg();
};

}  // namespace scoria::sim
