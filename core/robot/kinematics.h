// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "core/robot/description.h"

namespace scoria::core {

/// Pose of a body's link frame L in W.
struct LinkPose {
  Mat3 R_WL = Mat3::Identity();
  Vec3 p_WL = Vec3::Zero();
};

/// Poses of the trunk and the twelve links, in the order of BodyIndex.
[[nodiscard]] std::array<LinkPose, kNumBodies> CalcLinkPoses(const RobotDescription& robot,
                                                             const Vec3& p_WB, const Mat3& R_WB,
                                                             const LegArray<Vec3>& q) noexcept;

}  // namespace scoria::core
