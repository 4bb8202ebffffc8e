// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/state.h"

namespace scoria::core {

/// From one world frame W to another V with the same z axis: p_VP = R_z(yaw) p_WP + p_VW. An
/// estimate's world is so shifted against the true one, because no sensor shows place and heading.
struct WorldShift {
  double yaw_rad = 0.0;
  Vec3 p_VW = Vec3::Zero();

  /// @returns what takes `in_W` to place and heading of `in_V`, the same robot as V has it.
  [[nodiscard]] static WorldShift Between(const RobotState& in_W, const RobotState& in_V) noexcept;

  [[nodiscard]] RobotState Apply(const RobotState& in_W) const noexcept;
};

}  // namespace scoria::core
