// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <urdf_model/pose.h>

#include "core/math/types.h"

namespace scoria::core {

[[nodiscard]] inline Vec3 ToVec3(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

[[nodiscard]] inline Mat3 ToMat3(const urdf::Rotation& r) {
  double x, y, z, w;
  r.getQuaternion(x, y, z, w);
  return Quat(w, x, y, z).normalized().toRotationMatrix();
}

/// Of a URDF's link or geometry in the body that it is merged into.
struct UrdfPose {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
  [[nodiscard]] UrdfPose operator*(const urdf::Pose& X) const {
    return {R * ToMat3(X.rotation), p + R * ToVec3(X.position)};
  }
  /// Of the parent, where X is the child's pose in it.
  [[nodiscard]] UrdfPose Above(const urdf::Pose& X) const {
    const Mat3 R_parent = R * ToMat3(X.rotation).transpose();
    return {R_parent, p - R_parent * ToVec3(X.position)};
  }
};

}  // namespace scoria::core
