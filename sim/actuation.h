// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "core/math/delay_line.h"
#include "core/robot/description.h"
#include "core/robot/state.h"
#include "sim/battery.h"

namespace scoria::sim {

/// Energy drawn since the start, integrated every physics step. m is not in here: cost of transport
/// divides later.
struct EnergyMeter {
  double mech_abs_J = 0.0;    // Σ |τ ω|
  double mech_pos_J = 0.0;    // Σ max(τ ω, 0)
  double electrical_J = 0.0;  // idle + Σ max(0, τ ω + k τ²)
  double electrical_W = 0.0;  // now
  bool operator==(const EnergyMeter&) const = default;
};

/// Motors with gear: command delay, joint PD, torque-speed envelope, electrical power, battery.
/// The drive's joint PD acts on what its encoders measure; envelope, power and energy are physics
/// and take the true joint speeds.
/// Rotor inertia, damping and friction of the joints act inside the physics step (Plant).
class Actuation {
 public:
  explicit Actuation(const core::RobotDescription& robot);

  /// What a drive's encoders measure; borrowed for a call.
  struct Encoders {
    const LegArray<Vec3>& q;   // rad
    const LegArray<Vec3>& qd;  // rad/s
  };

  /// Motor torques under `command` for a step of dt.
  /// @param qd true joint speeds before the step, rad/s: they limit the torque.
  [[nodiscard]] const LegArray<Vec3>& Update(const JointCommand& command, const Encoders& measured,
                                             const LegArray<Vec3>& qd, double dt_s) noexcept;

  /// Meters the energy of the step that Update's torques have just driven. The work of a constant
  /// torque over a semi-implicit step is τ times the mean of the true speeds before and after it,
  /// as in the energy ledger (Plant).
  void Meter(const LegArray<Vec3>& qd_before, const LegArray<Vec3>& qd_after, double dt_s) noexcept;

  /// Motor torques of the last step, before friction.
  [[nodiscard]] const LegArray<Vec3>& motor_tau_Nm() const noexcept { return motor_tau_Nm_; }
  [[nodiscard]] const EnergyMeter& energy() const noexcept { return energy_; }
  [[nodiscard]] const BatteryState& battery() const noexcept { return battery_.state(); }

  /// Motors that are weaker or stronger than the robot's description says, from the next step on:
  /// scales the greatest torque at every speed. What the controller takes for the limit is its own.
  /// @pre scale >= 0.
  void SetTorqueLimitScale(double scale) noexcept { torque_limit_scale_ = scale; }

  /// Forgets torques and the commands that are still on their way, after the robot was placed.
  void Reset() noexcept {
    commands_.Clear();
    motor_tau_Nm_ = ZeroPerLeg();
  }

 private:
  [[nodiscard]] const JointCommand& Delayed(const JointCommand& command, double dt_s) noexcept;

  const core::RobotDescription& robot_;
  LegArray<Vec3> effort_Nm_;
  double torque_limit_scale_ = 1.0;
  LegArray<Vec3> motor_tau_Nm_ = ZeroPerLeg();
  EnergyMeter energy_;
  Battery battery_;
  static constexpr std::size_t kLongestDelay = 512;  // steps
  core::DelayLine<JointCommand> commands_;
};

}  // namespace scoria::sim
