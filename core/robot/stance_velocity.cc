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

Vec3 CalcFootStanceVelocity(const LegDescription& leg, const Mat3& R_WB, const Vec3& w_WB_W,
                            const Vec3& q, const Vec3& qd, StanceFoot foot) noexcept {
  const LegKinematics at = CalcLegKinematics(leg, q);
  Vec3 v_WB = -(w_WB_W.cross(R_WB * at.p_BF) + R_WB * (at.J * qd));
  if (foot == StanceFoot::kRolls) {
    const Vec3 w_shank_W = w_WB_W + R_WB * ShankRate(q, qd);
    v_WB += w_shank_W.cross(leg.foot_radius_m * Vec3::UnitZ());
  }
  return v_WB;
}

std::optional<Vec3> CalcStanceVelocity(const RobotDescription& robot, const Mat3& R_WB,
                                       const Vec3& w_WB_W, const LegArray<Vec3>& q,
                                       const LegArray<Vec3>& qd,
                                       const LegArray<bool>& contact) noexcept {
  Vec3 sum_W = Vec3::Zero();
  int standing = 0;
  for (const Leg leg : kLegs) {
    if (!contact[leg]) continue;
    sum_W +=
        CalcFootStanceVelocity(robot.legs[leg], R_WB, w_WB_W, q[leg], qd[leg], StanceFoot::kStays);
    ++standing;
  }
  if (standing == 0) return std::nullopt;
  return Vec3(sum_W / standing);
}

}  // namespace scoria::core
