// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/math/so3.h"
#include "core/robot/local_ground.h"
#include "terrains/heightfield.h"

namespace scoria::sim {

/// The ground as it is, around the robot as it is: for a controller that shall know it.
class TrueGround final : public LocalGround {
 public:
  /// Both are borrowed; `state` is the true one, as a plant keeps it.
  TrueGround(const terrains::Heightfield& ground, const RobotState& state) noexcept
      : ground_(ground), state_(state) {}

  [[nodiscard]] double HeightOverTrunk(const Vec2& p_BP_H) const noexcept override {
    const Mat3 R_WH = core::RotationZ(core::RpyFromRotation(state_.R_WB).z());
    const Vec3 p_WP = state_.p_WB + R_WH * Vec3(p_BP_H.x(), p_BP_H.y(), 0.0);
    return ground_.HeightAt(p_WP.x(), p_WP.y()) - state_.p_WB.z();
  }

 private:
  const terrains::Heightfield& ground_;
  const RobotState& state_;
};

}  // namespace scoria::sim
