// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/stance_velocity.h"

#include <cmath>

#include "core/robot/whole_body.h"

namespace scoria::core {
namespace {

/// Angular velocity of a shank against B, in B: HAA turns about x, HFE and KFE about the y that HAA
/// has turned.
Vec3 ShankRate(const Vec3& q, const Vec3& qd) {
  const Vec3 pitch_B(0.0, std::cos(q.x()), std::sin(q.x()));
  return qd.x() * Vec3::UnitX() + (qd.y() + qd.z()) * pitch_B;
}

}  // namespace

std::optional<Vec3> CalcStanceVelocity(const RobotDescription& robot, const Mat3& R_WB,
                                       const Vec3& w_WB_W, const LegArray<Vec3>& q,
                                       const LegArray<Vec3>& qd, const LegArray<bool>& contact,
                                       StanceFoot foot) noexcept {
  Vec3 sum_W = Vec3::Zero();
  int standing = 0;
  for (const Leg leg : kLegs) {
    if (!contact[leg]) continue;
    const LegKinematics at = CalcLegKinematics(robot.legs[leg], q[leg]);
    const Vec3 p_BF_W = R_WB * at.p_BF;
    sum_W -= w_WB_W.cross(p_BF_W) + R_WB * (at.J * qd[leg]);
    if (foot == StanceFoot::kRolls) {
      const Vec3 w_shank_W = w_WB_W + R_WB * ShankRate(q[leg], qd[leg]);
      sum_W += w_shank_W.cross(robot.legs[leg].foot_radius_m * Vec3::UnitZ());
    }
    ++standing;
  }
  if (standing == 0) return std::nullopt;
  return Vec3(sum_W / standing);
}

}  // namespace scoria::core
