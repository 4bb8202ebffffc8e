// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "core/robot/whole_body.h"

namespace scoria::test {

inline constexpr double kGravity_mps2 = 9.81, kStep_s = 1e-3;

constexpr int Ticks(double seconds) { return static_cast<int>(seconds / kStep_s + 0.5); }

/// A robot's state, its accelerations and the ground's forces, in W.
struct Motion {
  RobotState state;
  Vec3 vd_WB = Vec3::Zero(), wd_WB = Vec3::Zero();
  LegArray<Vec3> qdd = ZeroPerLeg(), f_F_W = ZeroPerLeg();
};

/// What ideal sensors read of a motion: torques by the equations of motion with the friction that
/// the momentum observer knows by default, the IMU by kinematics.
SensorFrame Sense(const core::RobotDescription& robot, const core::WholeBody& wb, const Motion& m);

}  // namespace scoria::test
