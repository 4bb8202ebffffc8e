// SPDX-License-Identifier: BSD-3-Clause
#include "controller/wbc/inverse_dynamics.h"

#include <Eigen/LU>

#include "core/math/so3.h"

namespace scoria::controller {
namespace {

/// Inverse of a leg Jacobian, damped: bounded where the leg is stretched, elsewhere within a few
/// per cent.
Mat3 DampedInverse(const Mat3& J, double damping_m) noexcept {
  const Mat3 A = J * J.transpose() + damping_m * damping_m * Mat3::Identity();
  return J.transpose() * A.inverse();
}

}  // namespace

/// The foot stays on the ground while the trunk, seen from the foot, moves to its target.
InverseDynamics::FootMotion InverseDynamics::Stance(
    const WbcInput& in, Leg leg, const BodyReference::Stage& target) const noexcept {
  const core::WholeBody& wb = in.wb;
  const Mat3 R_turn = core::RotationFromRpy(target.rpy_rad) * wb.state.R_WB.transpose();
  const Vec3 p_CF_W = wb.p_WF[leg] - target.p_WC;  // with the trunk where it shall be
  const Vec3 p_BC_W = wb.p_WC - wb.state.p_WB;
  FootMotion motion;
  motion.p_BF_W = R_turn.transpose() * p_CF_W + p_BC_W;
  motion.v_BF_W = -target.v_WC - target.w_WB.cross(wb.p_WF[leg] - wb.p_WC);
  motion.a_BF_W.setZero();
  return motion;
}

InverseDynamics::FootMotion InverseDynamics::Swing(const WbcInput& in, Leg leg) const noexcept {
  const core::WholeBody& wb = in.wb;
  const FootTarget& foot = in.feet[leg];
  FootMotion motion;
  motion.p_BF_W = foot.p_WF - wb.state.p_WB;
  motion.v_BF_W = foot.v_WF - wb.state.v_WB - wb.state.w_WB.cross(wb.p_BF_W[leg]);
  motion.a_BF_W = foot.a_WF;
  return motion;
}

WbcResult InverseDynamics::Solve(const WbcInput& in) noexcept {
  const core::WholeBody& wb = in.wb;
  WbcResult result;
  result.status = SolveStatus::kOptimal;
  result.target = in.forces.BodyAfter(in.plan_age_s + params_.target_lead_s);
  const LegArray<Vec3> f_planned = in.forces.ForcesFor(in.legs.Contacts(), in.n_W);
  for (const Leg leg : kLegs) {
    const bool stance = in.legs.InContact(leg);
    const FootMotion motion = stance ? Stance(in, leg, result.target) : Swing(in, leg);
    const Mat3 J_inverse = DampedInverse(wb.J_ll[leg], damping_m_);
    const double limit = params_.max_joint_error_rad;
    const Vec3 dq = (J_inverse * (motion.p_BF_W - wb.p_BF_W[leg])).cwiseMax(-limit).cwiseMin(limit);
    Vec3 tau = wb.h_l[leg];
    if (stance) {
      tau -= wb.J_ll[leg].transpose() * f_planned[leg];
      result.f_F_W[leg] = f_planned[leg];
    } else {
      tau += wb.H_ll[leg] * (J_inverse * (motion.a_BF_W - wb.Jd_v[leg]));
    }
    JointCommand& command = result.command;
    command.q[leg] = wb.state.q[leg] + dq;
    command.qd[leg] = J_inverse * motion.v_BF_W;
    command.tau_Nm[leg] = tau.cwiseMax(-effort_Nm_[leg]).cwiseMin(effort_Nm_[leg]);
    command.kp_Nm_per_rad[leg].setConstant(stance ? params_.stance_kp_Nm_per_rad
                                                  : params_.swing_kp_Nm_per_rad);
    command.kd_Nms_per_rad[leg].setConstant(stance ? params_.stance_kd_Nms_per_rad
                                                   : params_.swing_kd_Nms_per_rad);
    if (!tau.allFinite() || !dq.allFinite()) result.status = SolveStatus::kNumerical;
  }
  return result;
}

}  // namespace scoria::controller
