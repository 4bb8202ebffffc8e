// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/kinematics.h"

namespace scoria::core {

std::array<LinkPose, kNumBodies> CalcLinkPoses(const RobotDescription& robot, const Vec3& p_WB,
                                               const Mat3& R_WB, const LegArray<Vec3>& q) noexcept {
  std::array<LinkPose, kNumBodies> poses;
  poses[0] = {R_WB, p_WB};
  for (const Leg leg : kLegs) {
    LinkPose parent = poses[0];
    for (std::size_t j = 0; j < 3; ++j) {
      const JointDescription& joint = robot.legs[leg].joints[j];
      const Eigen::AngleAxisd turn(q[leg][static_cast<Eigen::Index>(j)], joint.axis_J);
      LinkPose pose;
      pose.p_WL = parent.p_WL + parent.R_WL * joint.p_PJ;
      pose.R_WL = parent.R_WL * joint.R_PJ * turn.toRotationMatrix();
      poses[static_cast<std::size_t>(BodyIndex(leg, static_cast<Joint>(j)))] = pose;
      parent = pose;
    }
  }
  return poses;
}

}  // namespace scoria::core
