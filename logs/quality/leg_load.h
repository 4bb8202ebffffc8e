// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/robot/whole_body.h"
#include "logs/quality/tick.h"

namespace scoria::logs {

/// The ground's force on a foot that torques tell, in B: f = -J^-T tau, without the leg's weight.
/// Nothing near a singularity, where torques tell little: below this of the leg's length cubed.
inline constexpr double kLeastDeterminant = 0.02;
[[nodiscard]] std::optional<Vec3> CalcFootForce(const core::LegKinematics& leg, const Vec3& tau,
                                                double leg_length_m);

/// Thigh and shank of a leg, m.
[[nodiscard]] double LegLength(const core::LegDescription& leg) noexcept;

/// The sum of the forces of all feet, in B. Nothing if a joint is not known, or a leg is stretched.
[[nodiscard]] std::optional<Vec3> CalcForceOfFeet(const core::RobotDescription& robot,
                                                  const Tick& tick);

}  // namespace scoria::logs
