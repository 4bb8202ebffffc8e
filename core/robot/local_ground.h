// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/math/so3.h"
#include "core/robot/state.h"

namespace scoria {

/// The ground around the robot, where somebody knows it. Places and heights are relative to the
/// trunk, so that the drift of an estimated position does not matter.
class LocalGround {
 public:
  virtual ~LocalGround() = default;
  /// Height of the ground over B's origin, m (negative below), at the horizontal offset p_BP in the
  /// heading frame H.
  [[nodiscard]] virtual double HeightOverTrunk(const Vec2& p_BP_H) const noexcept = 0;

  /// Height of the ground in the W in which `state` tells where the trunk is now.
  [[nodiscard]] double Height(const RobotState& state, const Vec3& p_WP) const noexcept {
    const Mat3 R_HW = core::RotationZ(-core::RpyFromRotation(state.R_WB).z());
    const Vec3 p_BP_H = R_HW * (p_WP - state.p_WB);
    return state.p_WB.z() + HeightOverTrunk(p_BP_H.head<2>());
  }
};

}  // namespace scoria
