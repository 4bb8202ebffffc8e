// SPDX-License-Identifier: BSD-3-Clause
#include "sim/actuation.h"

#include <algorithm>
#include <cmath>

namespace scoria::sim {
namespace {

/// Largest torque in the direction of motion: full effort up to this share of the no-load speed,
/// then linear to zero.
constexpr double kKneeShare = 0.7;

double Envelope(double tau, double qd, double effort, double no_load) noexcept {
  double limit = effort;
  if (tau * qd > 0.0 && no_load > 0.0) {
    const double above = (std::abs(qd) / no_load - kKneeShare) / (1.0 - kKneeShare);
    limit = effort * std::clamp(1.0 - above, 0.0, 1.0);
  }
  return std::clamp(tau, -limit, limit);
}

}  // namespace

Actuation::Actuation(const core::RobotDescription& robot)
    : robot_(robot),
      effort_Nm_(robot.EffortLimits()),
      battery_(robot.config.battery),
      commands_(kLongestDelay) {}

/// The command of delay_s ago; the first one until then.
const JointCommand& Actuation::Delayed(const JointCommand& command, double dt_s) noexcept {
  const auto delay = static_cast<std::size_t>(std::lround(robot_.config.motors.delay_s / dt_s));
  if (delay == 0) return command;
  commands_.Next() = command;
  return commands_.Ago(delay);
}

const LegArray<Vec3>& Actuation::Update(const JointCommand& given, const Encoders& measured,
                                        const LegArray<Vec3>& qd, double dt_s) noexcept {
  const JointCommand& command = Delayed(given, dt_s);
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const double wanted =
          command.tau_Nm[leg][j] +
          command.kp_Nm_per_rad[leg][j] * (command.q[leg][j] - measured.q[leg][j]) +
          command.kd_Nms_per_rad[leg][j] * (command.qd[leg][j] - measured.qd[leg][j]);
      const double no_load = robot_.legs[leg].joints[static_cast<std::size_t>(j)].velocity_radps;
      motor_tau_Nm_[leg][j] =
          Envelope(wanted, qd[leg][j], torque_limit_scale_ * effort_Nm_[leg][j], no_load);
    }
  }
  return motor_tau_Nm_;
}

void Actuation::Meter(const LegArray<Vec3>& qd_before, const LegArray<Vec3>& qd_after,
                      double dt_s) noexcept {
  const core::MotorParams& motors = robot_.config.motors;
  double electrical_W = motors.idle_W;
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const double tau = motor_tau_Nm_[leg][j];
      const double power_W = tau * 0.5 * (qd_before[leg][j] + qd_after[leg][j]);
      energy_.mech_abs_J += std::abs(power_W) * dt_s;
      energy_.mech_pos_J += std::max(power_W, 0.0) * dt_s;
      electrical_W += std::max(0.0, power_W + motors.copper_loss_W_per_Nm2[j] * tau * tau);
    }
  }
  energy_.electrical_J += electrical_W * dt_s;
  energy_.electrical_W = electrical_W;
  battery_.Draw(electrical_W, dt_s);
}

}  // namespace scoria::sim
