// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "analysis/field/velocity_smoother.h"
#include "core/robot/description.h"
#include "logs/row.h"

namespace scoria::analysis {

/// The trunk's attitude by whoever measured it: truth, estimate, or the IMU's own filter.
/// @param robot  how its IMU is mounted; null: along the trunk's axes.
[[nodiscard]] std::optional<Mat3> AttitudeOf(const logs::Row& row,
                                             const core::RobotDescription* robot);

/// Angular velocity of the trunk in B by the gyroscope, or the truth.
[[nodiscard]] std::optional<Vec3> RateOf(const logs::Row& row, const core::RobotDescription* robot);

/// What its legs and its IMU tell of the velocity of the IMU: feet in contact roll as spheres on
/// level ground and do not slip. No feet without joints, contacts, attitude and rate; no
/// acceleration without attitude; nothing of readings that are no numbers.
/// @param qd_radps  speeds of the joints.
[[nodiscard]] VelocityClue CalcVelocityClue(const core::RobotDescription& robot,
                                            const logs::Row& row,
                                            const std::optional<logs::Array12>& qd_radps,
                                            double gravity_mps2);

/// Places of the feet, and how fast they move against feet that roll.
struct FeetMotion {
  std::optional<logs::Array12> p_WF_m;
  LegArray<std::optional<double>> speed_mps;
};

/// By the trunk's motion (row.truth) and the joints; empty without them.
[[nodiscard]] FeetMotion CalcFeetMotion(const core::RobotDescription& robot, const logs::Row& row,
                                        const std::optional<logs::Array12>& qd_radps);

}  // namespace scoria::analysis
