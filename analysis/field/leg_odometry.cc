// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/leg_odometry.h"

#include <cmath>

#include "core/math/so3.h"
#include "core/robot/whole_body.h"
#include "logs/vectors.h"

namespace scoria::analysis {
namespace {

/// Angular velocity of a shank in B: HAA turns about x, HFE and KFE about the y that HAA has
/// turned.
Vec3 ShankRate(const Vec3& q, const Vec3& qd, const Vec3& w_WB_B) {
  const Vec3 pitch_B(0.0, std::cos(q.x()), std::sin(q.x()));
  return w_WB_B + qd.x() * Vec3::UnitX() + (qd.y() + qd.z()) * pitch_B;
}

}  // namespace

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
  const LegArray<Vec3> q = Unflatten(*row.measured->q_rad), qd = Unflatten(qd_radps);
  const Vec3 up_B = R_WB->transpose() * Vec3::UnitZ();
  Vec3 sum = Vec3::Zero();
  int feet = 0;
  for (const Leg leg : kLegs) {
    if (!row.contacts->contact[static_cast<std::size_t>(leg)]) continue;
    const core::LegKinematics foot = core::CalcLegKinematics(robot.legs[leg], q[leg]);
    const Vec3 rolls_B =
        ShankRate(q[leg], qd[leg], *w_WB_B).cross(robot.legs[leg].foot_radius_m * up_B);
    sum -= foot.J * qd[leg] + w_WB_B->cross(foot.p_BF) - rolls_B;
    ++feet;
  }
  if (feet == 0) return std::nullopt;
  return Vec3(*R_WB * sum / feet);
}

}  // namespace scoria::analysis
