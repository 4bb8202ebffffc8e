// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/leg_odometry.h"

#include "core/math/so3.h"
#include "core/robot/stance_velocity.h"
#include "core/robot/whole_body.h"
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

VelocityClue CalcVelocityClue(const core::RobotDescription& robot, const logs::Row& row,
                              const std::optional<logs::Array12>& qd_radps, double gravity_mps2) {
  VelocityClue clue{.time_s = row.time_s};
  const std::optional<Mat3> R_WB = AttitudeOf(row, &robot);
  if (!R_WB || !row.measured) return clue;
  if (row.measured->a_WS_S_mps2) {
    const Vec3 a_WS_S = logs::ToVec3(*row.measured->a_WS_S_mps2);
    const Vec3 a_WS = *R_WB * (robot.R_BS * a_WS_S) - gravity_mps2 * Vec3::UnitZ();
    if (a_WS.allFinite()) clue.a_WS = a_WS;
  }
  const std::optional<Vec3> w_WB_B = RateOf(row, &robot);
  if (!w_WB_B || !row.contacts || !row.measured->q_rad || !qd_radps) return clue;
  const Vec3 w_WB_W = *R_WB * *w_WB_B;
  const LegArray<Vec3> q = Unflatten(*row.measured->q_rad), qd = Unflatten(*qd_radps);
  for (const Leg leg : kLegs) {
    if (!row.contacts->contact[static_cast<std::size_t>(leg)]) continue;
    const Vec3 v_WB = core::CalcFootStanceVelocity(robot.legs[leg], *R_WB, w_WB_W, q[leg], qd[leg],
                                                   core::StanceFoot::kRolls);
    const Vec3 v_WS = v_WB + w_WB_W.cross(*R_WB * robot.p_BS);
    if (v_WS.allFinite()) clue.v_WS[leg] = v_WS;
  }
  return clue;
}

FeetMotion CalcFeetMotion(const core::RobotDescription& robot, const logs::Row& row,
                          const std::optional<logs::Array12>& qd_radps) {
  FeetMotion feet;
  if (!row.truth || !row.measured || !row.measured->q_rad) return feet;
  const Mat3 R_WB = core::RotationFromRpy(logs::ToVec3(row.truth->rpy_rad));
  const Vec3 p_WB = logs::ToVec3(row.truth->p_WB_m), v_WB = logs::ToVec3(row.truth->v_WB_mps);
  const Vec3 w_WB_W = logs::ToVec3(row.truth->w_WB_radps);
  const LegArray<Vec3> q = Unflatten(*row.measured->q_rad);
  LegArray<Vec3> p_WF = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    p_WF[leg] = p_WB + R_WB * core::CalcLegKinematics(robot.legs[leg], q[leg]).p_BF;
    if (!qd_radps) continue;
    const Vec3 v_rolling = core::CalcFootStanceVelocity(
        robot.legs[leg], R_WB, w_WB_W, q[leg], Unflatten(*qd_radps)[leg], core::StanceFoot::kRolls);
    feet.speed_mps[leg] = (v_WB - v_rolling).norm();
  }
  feet.p_WF_m = Flatten(p_WF);
  return feet;
}

}  // namespace scoria::analysis
