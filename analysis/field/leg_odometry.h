// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/robot/description.h"
#include "logs/row.h"

namespace scoria::analysis {

/// The trunk's attitude by whoever measured it: truth, estimate, or the IMU's own filter.
/// @param robot  how its IMU is mounted; null: along the trunk's axes.
[[nodiscard]] std::optional<Mat3> AttitudeOf(const logs::Row& row,
                                             const core::RobotDescription* robot);

/// Angular velocity of the trunk in B by the gyroscope, or the truth.
[[nodiscard]] std::optional<Vec3> RateOf(const logs::Row& row, const core::RobotDescription* robot);

/// Velocity of the trunk in W that its feet in contact tell, as if they rolled on the ground and
/// none slipped (core::CalcStanceVelocity). Nothing without joints, contacts, attitude or rate, or
/// without a foot in contact.
/// @param qd_radps  speeds of the joints.
[[nodiscard]] std::optional<Vec3> CalcLegVelocity(const core::RobotDescription& robot,
                                                  const logs::Row& row,
                                                  const logs::Array12& qd_radps);

}  // namespace scoria::analysis
