// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/robot/description.h"

namespace scoria::core {

/// How a standing foot moves, none of which slips.
enum class StanceFoot {
  kStays,  // its centre does
  kRolls,  // as a sphere on level ground
};

/// Velocity of B that a standing foot tells: -(J qd + w × p_BF) in W, and w_shank × r up where it
/// rolls.
/// @param w_WB_W  rad/s, in W.    @param q, qd  of the leg.
/// @returns m/s, in W.
[[nodiscard]] Vec3 CalcFootStanceVelocity(const LegDescription& leg, const Mat3& R_WB,
                                          const Vec3& w_WB_W, const Vec3& q, const Vec3& qd,
                                          StanceFoot foot) noexcept;

/// The mean of what the standing feet tell whose centres stay.
/// @param w_WB_W  rad/s, in W.    @param contact  feet that stand.
/// @returns m/s, in W; none if no foot stands.
[[nodiscard]] std::optional<Vec3> CalcStanceVelocity(const RobotDescription& robot,
                                                     const Mat3& R_WB, const Vec3& w_WB_W,
                                                     const LegArray<Vec3>& q,
                                                     const LegArray<Vec3>& qd,
                                                     const LegArray<bool>& contact) noexcept;

}  // namespace scoria::core
