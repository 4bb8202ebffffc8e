// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <LinearMath/btTransform.h>

#include "core/math/types.h"

namespace scoria::sim {

[[nodiscard]] inline btVector3 ToBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
[[nodiscard]] inline btTransform ToBullet(const Mat3& R, const Vec3& p) {
  return btTransform(
      btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      ToBullet(p));
}
[[nodiscard]] inline Vec3 ToVec3(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace scoria::sim
