// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "sim/world.h"

namespace scoria::sim {

/// What ideal sensors read of the truth: encoders, motor torque, IMU at its pose, normal foot
/// force.
class Sensors {
 public:
  Sensors(const core::RobotDescription& robot, const Vec3& gravity_W, double step_s);

  /// @param give_truth fills SensorFrame::truth; only for controllers that run on the `truth`
  /// estimator.
  [[nodiscard]] SensorFrame Read(const Truth& truth, const LegArray<Vec3>& motor_tau_Nm,
                                 std::int64_t step, bool give_truth) noexcept;

  /// Forgets the last velocity, after the robot was placed somewhere.
  void Reset() noexcept { has_velocity_ = false; }

 private:
  const core::RobotDescription& robot_;
  Vec3 gravity_W_;
  double step_s_;
  Vec3 v_WS_ = Vec3::Zero();
  bool has_velocity_ = false;
};

/// Normal force above which a foot truly stands.
inline constexpr double kTrueContactForce_N = 5.0;

}  // namespace scoria::sim
