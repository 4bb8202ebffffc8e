// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/leg_tick.h"

#include <algorithm>
#include <cmath>

namespace scoria::logs {
namespace {

// How far loaded feet, taken right, are from the ideal: ground is uneven, legs have mass, friction
// is at work.
constexpr double kHeight_m = 0.06;
constexpr double kForceAngle_rad = 0.35;
constexpr double kBeyond_rad = 0.05;
constexpr double kEquilibrium = 0.5;  // of the mean specific force
/// Torques of a leg that bears a share of the robot: of its quarter at the leg's length. Less have
/// the legs of a robot that lies.
constexpr double kLeastLoad = 0.05;
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
  height_B += (foot.p_BF.z() - height_B) / count;
}

double CalcCost(const core::LegDescription& leg, const Vec3& q, const FootMotion& foot,
                const LegTick& tick, const OtherFeet& others, const CostSizes& sizes) {
  double cost = kLargestCost;
  if (foot.f_B) {
    const double angle = std::atan2(foot.f_B->cross(tick.up_B).norm(), foot.f_B->dot(tick.up_B));
    cost = RobustCost(angle * angle, kForceAngle_rad);
  }
  const auto speed_cost = [&](const Vec3& v_B) {
    return RobustCost((foot.v_B - v_B).squaredNorm(), sizes.floor_mps + sizes.share * v_B.norm());
  };
  const double height = foot.p_BF.dot(tick.up_B), length = LegLength(leg);
  if (others.count > 0) {
    cost += speed_cost(others.v_B);
  }
  if (others.count > 0 && sizes.has_heights) {
    // Ground is level, or a slope that the trunk is parallel to.
    const double apart =
        std::min(std::abs(height - others.height), std::abs(foot.p_BF.z() - others.height_B));
    cost += RobustCost(apart * apart, kHeight_m);
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

LegTickMaker::LegTickMaker(const core::RobotDescription& robot, double gravity_mps2)
    : stance_(kLeastLoad * robot.total_mass_kg() * gravity_mps2 / kNumLegs *
              LegLength(robot.legs[Leg::kFL])) {}

std::optional<LegTick> LegTickMaker::Make(const Tick& tick) {
  if (tick.a_WS_B) {
    const double size = tick.a_WS_B->norm();
    specific_force_.Add(size);
    if (std::abs(size - specific_force_.mean()) > kEquilibrium * specific_force_.mean()) {
      ++far_;
      return std::nullopt;
    }
  }
  const std::optional<Vec3> rate = RateOf(tick);
  if (!tick.q || !tick.qd || !tick.tau || !rate) return std::nullopt;
  LegTick out;
  out.q = *tick.q;
  out.qd = *tick.qd;
  out.tau = *tick.tau;
  out.loaded = stance_.Update(*tick.tau);
  out.w_WB_B = *rate;
  out.num_loaded = static_cast<int>(std::count(out.loaded.begin(), out.loaded.end(), true));
  if (const auto R_WB = AttitudeOf(tick)) {
    out.up_B = R_WB->row(2).transpose();
    if (const auto v_WB = VelocityOf(tick)) out.v_WB_B = R_WB->transpose() * *v_WB;
  }
  return out;
}

}  // namespace scoria::logs
