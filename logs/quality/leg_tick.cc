// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/leg_tick.h"

#include <algorithm>
#include <cmath>

#include "logs/quality/statistics.h"

namespace scoria::logs {
namespace {

// How far loaded feet, taken right, are from the ideal: ground is uneven, legs have mass, friction
// is at work.
constexpr double kHeight_m = 0.06;
constexpr double kForceAngle_rad = 0.35;
constexpr double kBeyond_rad = 0.05;
constexpr double kDepthShare = 0.5, kDepthSize = 0.25;  // of the leg's length, below the trunk

}  // namespace

FootMotion CalcFootMotion(const core::LegDescription& leg, const Vec3& q, const Vec3& qd,
                          const Vec3& tau, const Vec3& w_WB_B) {
  const core::LegKinematics kinematics = core::CalcLegKinematics(leg, q);
  FootMotion motion;
  motion.p_BF = kinematics.p_BF;
  motion.v_B = -(w_WB_B.cross(kinematics.p_BF) + kinematics.J * qd);
  motion.f_B = CalcFootForce(kinematics, tau, LegLength(leg));
  return motion;
}

void OtherFeet::Add(const FootMotion& foot, const Vec3& up_B) {
  ++count;
  v_B += (foot.v_B - v_B) / count;
  height += (foot.p_BF.dot(up_B) - height) / count;
}

double CalcCost(const core::LegDescription& leg, const Vec3& q, const FootMotion& foot,
                const LegTick& tick, const OtherFeet& others, const SpeedSize& speed) {
  double cost = kLargestCost;
  if (foot.f_B) {
    const double angle = std::atan2(foot.f_B->cross(tick.up_B).norm(), foot.f_B->dot(tick.up_B));
    cost = RobustCost(angle * angle, kForceAngle_rad);
  }
  const auto speed_cost = [&](const Vec3& v_B) {
    return RobustCost((foot.v_B - v_B).squaredNorm(), speed.floor_mps + speed.share * v_B.norm());
  };
  const double height = foot.p_BF.dot(tick.up_B), length = LegLength(leg);
  if (others.count > 0) {
    cost += speed_cost(others.v_B);
    cost += RobustCost((height - others.height) * (height - others.height), kHeight_m);
  }
  if (tick.v_WB_B) cost += speed_cost(*tick.v_WB_B);
  const double above = std::max(0.0, height + kDepthShare * length);
  cost += RobustCost(above * above, kDepthSize * length);
  double beyond = 0.0;
  for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
    const double angle = q[static_cast<Eigen::Index>(j)];
    beyond = std::max({beyond, leg.joints[j].lower_rad - angle, angle - leg.joints[j].upper_rad});
  }
  return cost + RobustCost(beyond * beyond, kBeyond_rad);
}

std::optional<LegTick> MakeLegTick(const Tick& tick, StanceByTorque& stance) {
  const std::optional<Vec3> rate = RateOf(tick);
  if (!tick.q || !tick.qd || !tick.tau || !rate) return std::nullopt;
  LegTick out;
  out.q = *tick.q;
  out.qd = *tick.qd;
  out.tau = *tick.tau;
  out.loaded = stance.Update(*tick.tau);
  out.w_WB_B = *rate;
  out.num_loaded = static_cast<int>(std::count(out.loaded.begin(), out.loaded.end(), true));
  if (const auto R_WB = AttitudeOf(tick)) {
    out.up_B = R_WB->row(2).transpose();
    if (const auto v_WB = VelocityOf(tick)) out.v_WB_B = R_WB->transpose() * *v_WB;
  }
  return out;
}

}  // namespace scoria::logs
