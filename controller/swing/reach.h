// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/whole_body.h"

namespace scoria::controller {

/// `p_WF` drawn towards the leg's hip along the straight line until it is within max_leg_length_m
/// of it.
/// @param p_WB, R_WB trunk at the time the foot shall be there.
[[nodiscard]] inline Vec3 ClipToReach(const core::RobotDescription& robot, Leg leg,
                                      const Vec3& p_WB, const Mat3& R_WB,
                                      const Vec3& p_WF) noexcept {
  const Vec3 p_WHip = p_WB + R_WB * robot.legs[leg].joints[0].p_PJ;
  const Vec3 d = p_WF - p_WHip;
  const double longest_m = robot.config.max_leg_length_m;
  return d.norm() <= longest_m ? p_WF : Vec3(p_WHip + longest_m / d.norm() * d);
}

}  // namespace scoria::controller
