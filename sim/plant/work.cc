// SPDX-License-Identifier: BSD-3-Clause
#include "sim/plant/work.h"

namespace scoria::sim {
namespace {

/// Velocity of a point of a body, in W, by the velocities of `state` and the kinematics of `wb`.
Vec3 CalcPointVelocity(const core::WholeBody& wb, const RobotState& state, const ContactPoint& c) {
  Vec3 v_WP = state.v_WB + state.w_WB.cross(c.p_BP_W);
  if (c.body == 0) return v_WP;
  const Leg leg = core::LegOf(c.body);
  for (int j = 0; j <= static_cast<int>(core::JointOf(c.body)); ++j) {
    const Vec3 z_W = wb.Jw_ll[leg].col(j), p_JP_W = c.p_BP_W - wb.p_BJ_W[leg].col(j);
    v_WP += state.qd[leg][j] * z_W.cross(p_JP_W);
  }
  return v_WP;
}

}  // namespace

Work CalcWork(const StepInput& in, const StepResult& result,
              std::span<const ContactPoint> contacts) noexcept {
  const RobotState &before = in.wb.state, &after = result.state;
  RobotState mean;
  mean.v_WB = 0.5 * (before.v_WB + after.v_WB);
  mean.w_WB = 0.5 * (before.w_WB + after.w_WB);
  Work work;
  work.external_J =
      in.dt_s * (in.wrench_B_W.head<3>().dot(mean.v_WB) + in.wrench_B_W.tail<3>().dot(mean.w_WB));
  for (const Leg leg : kLegs) {
    mean.qd[leg] = 0.5 * (before.qd[leg] + after.qd[leg]);
    work.motor_J += in.dt_s * in.tau_Nm[leg].dot(mean.qd[leg]);
    work.joint_J += result.joint_impulse[leg].dot(mean.qd[leg]);
  }
  for (const ContactPoint& c : contacts)
    work.contact_J += c.impulse_W.dot(CalcPointVelocity(in.wb, mean, c));
  return work;
}

}  // namespace scoria::sim
