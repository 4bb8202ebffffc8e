// SPDX-License-Identifier: BSD-3-Clause
#include "controller/wbc/tsid.h"

#include <Eigen/LU>

#include "core/math/so3.h"

namespace scoria::controller {

using core::Skew;

Tsid::Tsid(const TsidParams& params, const core::RobotDescription& robot)
    : params_(params),
      robot_(robot),
      effort_Nm_(robot.EffortLimits()),
      dense_(params.formulation == TsidFormulation::kFull ? TsidVariables::kFull
                                                          : TsidVariables::kReduced) {}

/// Equations of motion, and contact points that keep still.
void Tsid::AddMotion(const WbcInput& in) noexcept {
  const core::WholeBody& wb = in.wb;
  last_.problem.stance = in.legs.Contacts();
  last_.problem.H_BB = wb.H_BB;
  last_.problem.h_B = wb.h_B;
  last_.problem.H_Bl = wb.H_Bl;
  last_.problem.H_ll = wb.H_ll;
  last_.problem.h_l = wb.h_l;
  for (const Leg leg : kLegs) {
    if (!last_.problem.stance[leg]) continue;
    const Vec3 down =
        -robot_.legs[leg].foot_radius_m * in.n_W;  // from the centre to the contact point
    const Mat3 rolling = Skew(down);
    last_.problem.J[leg] = wb.J_ll[leg] - rolling * wb.Jw_ll[leg];
    last_.problem.J_B[leg] << Mat3::Identity(), -Skew(wb.p_BF_W[leg]) - rolling;
    const Vec3 v_contact = wb.v_WF[leg] + wb.w_shank_W[leg].cross(down);
    last_.problem.a_c[leg] =
        -(wb.Jd_v[leg] + wb.Jwd_v[leg].cross(down)) - params_.contact_damping_per_s * v_contact;
  }
}

/// The COM's acceleration Σ f / m + g and the planned force of every foot. Gravity on both sides
/// cancels.
void Tsid::AddForceTasks(const WbcInput& in, const LegArray<Vec3>& f_planned,
                         const BodyReference::Stage& target) noexcept {
  const core::WholeBody& wb = in.wb;
  Vec3 f_sum = Vec3::Zero();
  for (const Leg leg : kLegs) {
    if (last_.problem.stance[leg]) f_sum += f_planned[leg];
  }
  const Vec3 a_com = f_sum / wb.mass_kg + params_.com_kp * (target.p_WC - wb.p_WC) +
                     params_.com_kd * (target.v_WC - wb.v_WC);
  const double per_mass = params_.com_weight / wb.mass_kg, shared = per_mass / wb.mass_kg;
  last_.problem.G_ff.setZero();
  last_.problem.g_f.setZero();
  for (const Leg leg : kLegs) {
    if (!last_.problem.stance[leg]) continue;
    const int at = 3 * static_cast<int>(leg);
    last_.problem.g_f.segment<3>(at) = -per_mass * a_com - params_.force_weight * f_planned[leg];
    for (const Leg other : kLegs) {
      if (!last_.problem.stance[other]) continue;
      const double own = leg == other ? params_.force_weight + params_.regularisation : 0.0;
      last_.problem.G_ff.block<3, 3>(at, 3 * static_cast<int>(other)) =
          (shared + own) * Mat3::Identity();
    }
  }
}

void Tsid::AddTrunkTask(const WbcInput& in, const LegArray<Vec3>& f_planned,
                        const BodyReference::Stage& target) noexcept {
  const core::WholeBody& wb = in.wb;
  Vec3 t_sum = Vec3::Zero();  // moment of the planned forces about the COM
  for (const Leg leg : kLegs) {
    if (!last_.problem.stance[leg]) continue;
    const Vec3 p_CP_W = wb.p_WF[leg] - robot_.legs[leg].foot_radius_m * in.n_W - wb.p_WC;
    t_sum += p_CP_W.cross(f_planned[leg]);
  }
  const Mat3 R_error = core::RotationFromRpy(target.rpy_rad) * wb.state.R_WB.transpose();
  const Vec3 alpha = wb.I_C_W.inverse() * t_sum + params_.orientation_kp * core::LogSo3(R_error) +
                     params_.orientation_kd * (target.w_WB - wb.state.w_WB);
  last_.problem.G_BB.setZero();
  last_.problem.g_B.setZero();
  last_.problem.G_BB.diagonal().tail<3>().setConstant(params_.orientation_weight);
  last_.problem.g_B.tail<3>() = -params_.orientation_weight * alpha;
}

void Tsid::AddSwingTasks(const WbcInput& in) noexcept {
  const core::WholeBody& wb = in.wb;
  for (const Leg leg : kLegs) {
    last_.problem.G_Bl[leg].setZero();
    last_.problem.G_ll[leg].setZero();
    last_.problem.g_l[leg].setZero();
    if (last_.problem.stance[leg]) continue;
    const FootTarget& foot = in.feet[leg];
    Vec3 a = foot.a_WF + params_.swing_kp * (foot.p_WF - wb.p_WF[leg]) +
             params_.swing_kd * (foot.v_WF - wb.v_WF[leg]);
    if (a.norm() > params_.max_swing_acceleration_mps2) {
      a *= params_.max_swing_acceleration_mps2 / a.norm();
    }
    a -= wb.Jd_v[leg];
    Mat36 J_B;
    J_B << Mat3::Identity(), -Skew(wb.p_BF_W[leg]);
    const Mat3& J = wb.J_ll[leg];
    const double w = params_.swing_weight;
    last_.problem.G_BB += w * J_B.transpose().lazyProduct(J_B);
    last_.problem.G_Bl[leg] = w * J_B.transpose().lazyProduct(J);
    last_.problem.G_ll[leg] = w * J.transpose() * J + params_.regularisation * Mat3::Identity();
    last_.problem.g_B -= w * J_B.transpose() * a;
    last_.problem.g_l[leg] = -w * J.transpose() * a;
  }
}

void Tsid::AddLimits(const WbcInput& in) noexcept {
  const Mat3 R_WT = GroundFrame(in.n_W, core::RpyFromRotation(in.wb.state.R_WB).z());
  const Vec3 x = R_WT.col(0), y = R_WT.col(1), n = R_WT.col(2);
  TsidProblem::Cone cone;
  cone << (params_.friction * n - x).transpose(), (params_.friction * n + x).transpose(),
      (params_.friction * n - y).transpose(), (params_.friction * n + y).transpose(), n.transpose();
  TsidProblem::Vec5 low = TsidProblem::Vec5::Zero();
  low[4] = params_.f_min_N;
  last_.problem.cone = LegArray<TsidProblem::Cone>(cone);
  last_.problem.cone_min = LegArray<TsidProblem::Vec5>(low);
  last_.problem.tau_max = effort_Nm_;
  for (const Leg leg : kLegs) last_.problem.tau_min[leg] = -effort_Nm_[leg];
}

TsidSolution Tsid::SolveForm(bool limit_torques) noexcept {
  last_.problem.limit_torques = limit_torques;
  if (params_.formulation != TsidFormulation::kNullspace) return dense_.Solve(last_.problem);
  TsidSolution solution = nullspace_.Solve(last_.problem);
  if (solution.singular_leg) {
    solution = dense_.Solve(last_.problem);
    solution.singular_leg = true;
  }
  return solution;
}

WbcResult Tsid::Solve(const WbcInput& in) noexcept {
  WbcResult result;
  result.target = in.forces.BodyAfter(in.plan_age_s + params_.target_lead_s);
  const LegArray<Vec3> f_planned = in.forces.ForcesFor(in.legs.Contacts(), in.n_W);
  AddMotion(in);
  AddForceTasks(in, f_planned, result.target);
  AddTrunkTask(in, f_planned, result.target);
  AddSwingTasks(in);
  AddLimits(in);
  last_.solution = SolveForm(true);
  if (last_.solution.status != SolveStatus::kOptimal) {
    result.torque_rows_dropped = true;
    last_.solution = SolveForm(false);
  }
  result.status = last_.solution.status;
  result.iterations = last_.solution.iterations;
  result.singular_leg = last_.solution.singular_leg;
  if (result.status != SolveStatus::kOptimal) {  // unfinished dual iterates violate rows
    result.status = SolveStatus::kNumerical;
    return result;
  }
  for (const Leg leg : kLegs) {
    result.command.tau_Nm[leg] =
        last_.solution.tau[leg].cwiseMax(-effort_Nm_[leg]).cwiseMin(effort_Nm_[leg]);
    result.command.q[leg] = in.wb.state.q[leg];
    result.command.qd[leg] = in.wb.state.qd[leg];
    result.f_F_W[leg] = last_.solution.f[leg];
    if (!result.command.tau_Nm[leg].allFinite()) result.status = SolveStatus::kNumerical;
  }
  return result;
}

}  // namespace scoria::controller
