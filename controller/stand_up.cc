// SPDX-License-Identifier: BSD-3-Clause
#include "controller/stand_up.h"

#include <algorithm>

#include "core/robot/normalise.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

LegArray<Vec3> StandingPose(const core::RobotDescription& robot, double height_m) {
  LegArray<Vec3> pose = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    Vec3 p_BF = robot.NeutralFoothold(leg);
    p_BF.z() = -height_m;
    // The knee bends backwards, unless its limits forbid it.
    const double way = -core::KneeWay(robot.legs[leg]);
    const Vec3 guess(0.0, 0.8 * way, -1.6 * way);
    pose[leg] = core::SolveLegIk(robot.legs[leg], p_BF, guess);
  }
  return pose;
}

JointCommand StandUp::Update(const LegArray<Vec3>& q, double time_s) noexcept {
  if (!started_) {
    started_ = true;
    start_ = q;
  }
  const double s = std::clamp(time_s / params_.duration_s, 0.0, 1.0);
  const double blend = s * s * (3.0 - 2.0 * s), rate = 6.0 * s * (1.0 - s) / params_.duration_s;
  const LegArray<Vec3>& goal = goal_ ? *goal_ : start_;
  JointCommand command;
  for (const Leg leg : kLegs) {
    command.q[leg] = start_[leg] + blend * (goal[leg] - start_[leg]);
    command.qd[leg] = rate * (goal[leg] - start_[leg]);
    command.kp_Nm_per_rad[leg].setConstant(params_.kp_Nm_per_rad);
    command.kd_Nms_per_rad[leg].setConstant(params_.kd_Nms_per_rad);
  }
  return command;
}

}  // namespace scoria::controller
