// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/leg_odometry.h"

#include "core/math/so3.h"
#include "core/robot/stance_velocity.h"
#include "logs/vectors.h"

namespace scoria::analysis {

std::optional<Mat3> AttitudeOf(const logs::Row& row, const core::RobotDescription* robot) {
  if (row.truth) return core::RotationFromRpy(logs::ToVec3(row.truth->rpy_rad));
  if (row.estimate) return core::RotationFromRpy(logs::ToVec3(row.estimate->rpy_rad));
  if (!row.measured || !row.measured->rpy_WS_rad) return std::nullopt;
  const Mat3 R_WS = core::RotationFromRpy(logs::ToVec3(*row.measured->rpy_WS_rad));
  return robot != nullptr ? Mat3(R_WS * robot->R_BS.transpose()) : R_WS;
}

std::optional<Vec3> RateOf(const logs::Row& row, const core::RobotDescription* robot) {
  if (row.measured && row.measured->w_WS_S_radps) {
    const Vec3 w_WS_S = logs::ToVec3(*row.measured->w_WS_S_radps);
    return robot != nullptr ? Vec3(robot->R_BS * w_WS_S) : w_WS_S;
  }
  if (!row.truth) return std::nullopt;
  return Vec3(core::RotationFromRpy(logs::ToVec3(row.truth->rpy_rad)).transpose() *
              logs::ToVec3(row.truth->w_WB_radps));
}

std::optional<Vec3> CalcLegVelocity(const core::RobotDescription& robot, const logs::Row& row,
                                    const logs::Array12& qd_radps) {
  const std::optional<Mat3> R_WB = AttitudeOf(row, &robot);
  const std::optional<Vec3> w_WB_B = RateOf(row, &robot);
  if (!R_WB || !w_WB_B || !row.contacts || !row.measured || !row.measured->q_rad)
    return std::nullopt;
  LegArray<bool> contact;
  for (const Leg leg : kLegs) contact[leg] = row.contacts->contact[static_cast<std::size_t>(leg)];
  return core::CalcStanceVelocity(robot, *R_WB, *R_WB * *w_WB_B, Unflatten(*row.measured->q_rad),
                                  Unflatten(qd_radps), contact, core::StanceFoot::kRolls);
}

}  // namespace scoria::analysis
