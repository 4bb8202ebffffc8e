// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

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
/// Rotor inertia, damping and friction of the joints act inside the physics step (World).
class Actuation {
 public:
  explicit Actuation(const core::RobotDescription& robot);

  /// Torque at the joints under `command` at joint state (q, qd), for a step of dt. Also meters the
  /// energy.
  [[nodiscard]] LegArray<Vec3> Update(const JointCommand& command, const LegArray<Vec3>& q,
                                      const LegArray<Vec3>& qd, double dt_s) noexcept;

  /// Motor torques of the last step, before friction.
  [[nodiscard]] const LegArray<Vec3>& motor_tau_Nm() const noexcept { return motor_tau_Nm_; }
  [[nodiscard]] const EnergyMeter& energy() const noexcept { return energy_; }
  [[nodiscard]] const BatteryState& battery() const noexcept { return battery_.state(); }

  /// Forgets torques and the commands that are still on their way, after the robot was placed.
  void Reset() noexcept {
    pending_ = 0;
    motor_tau_Nm_ = ZeroPerLeg();
  }

 private:
  [[nodiscard]] const JointCommand& Delayed(const JointCommand& command, double dt_s) noexcept;

  const core::RobotDescription& robot_;
  LegArray<Vec3> effort_Nm_;
  LegArray<Vec3> motor_tau_Nm_ = ZeroPerLeg();
  EnergyMeter energy_;
  Battery battery_;
  static constexpr std::size_t kLongestDelay = 512;  // steps
  std::vector<JointCommand> commands_;               // ring of those on their way
  std::size_t pending_ = 0, next_ = 0;
};

}  // namespace scoria::sim
