// SPDX-License-Identifier: BSD-3-Clause
#include "controller/wbc/tsid.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/math/so3.h"

namespace scoria::controller {
namespace {

using core::Skew;

/// Inverse of a leg Jacobian; damped when the leg is nearly stretched, where the exact inverse
/// explodes.
Mat3 SafeInverse(const Mat3& J) noexcept {
  constexpr double kSingular_m3 = 1e-3;  // |det| of a Go2 leg at ordinary poses is 5e-3 to 2e-2
  constexpr double kDamping_m = 0.03;
  if (std::abs(J.determinant()) > kSingular_m3) return J.inverse();
  const Mat3 A = J * J.transpose() + kDamping_m * kDamping_m * Mat3::Identity();
  return J.transpose() * A.inverse();
}

/// Body target on the MPC's predicted motion.
BodyReference::Stage Interpolate(const ForcePlan& plan, double ahead_s) noexcept {
  const double at = std::clamp(ahead_s / plan.dt_s, 0.0, ForcePlan::kStages - 1.001);
  const auto k = static_cast<std::size_t>(at);
  const double s = at - static_cast<double>(k);
  const auto mix = [s](const Vec3& a, const Vec3& b) { return Vec3(a + s * (b - a)); };
  const BodyReference::Stage &a = plan.body[k], &b = plan.body[k + 1];
  return {mix(a.rpy_rad, b.rpy_rad), mix(a.p_WC, b.p_WC), mix(a.w_WB, b.w_WB), mix(a.v_WC, b.v_WC)};
}

}  // namespace

TsidNullspace::TsidNullspace(const TsidParams& params, const core::RobotDescription& robot)
    : params_(params), robot_(robot), effort_Nm_(robot.EffortLimits()) {}

/// With qdd_l = J⁻¹(a_c − J_B a) in stance legs, the trunk's equation of motion becomes
///   (H_BB − Σ X_l J_Bl) a = Σ J_Blᵀ f_l − Σ_swing H_Bl qdd_l − h_B − Σ X_l a_c,l,   X_l = H_Bl
///   J_l⁻¹.
void TsidNullspace::Reduce(const WbcInput& in) noexcept {
  const core::WholeBody& wb = in.wb;
  LegArray<Mat3> J, J_inverse;
  LegArray<Eigen::Matrix<double, 3, 6>> J_B;
  LegArray<Vec3> a_c;
  Mat6 M = wb.H_BB;
  Vec6 rhs_0 = -wb.h_B;
  Eigen::Matrix<double, 6, 12> rhs;
  for (const Leg leg : kLegs) {
    const int at = 3 * static_cast<int>(leg);
    if (!in.legs.InContact(leg)) {
      rhs.middleCols<3>(at) = -wb.H_Bl[leg];
      continue;
    }
    const Vec3 down =
        -robot_.legs[leg].foot_radius_m * in.n_W;  // from the centre to the contact point
    const Mat3 rolling = Skew(down);
    J[leg] = wb.J_ll[leg] - rolling * wb.Jw_ll[leg];
    J_inverse[leg] = SafeInverse(J[leg]);
    J_B[leg] << Mat3::Identity(), -Skew(wb.p_BF_W[leg]) - rolling;
    const Vec3 v_contact = wb.v_WF[leg] + wb.w_shank_W[leg].cross(down);
    a_c[leg] =
        -(wb.Jd_v[leg] + wb.Jwd_v[leg].cross(down)) - params_.contact_damping_per_s * v_contact;
    const Mat63 X = wb.H_Bl[leg] * J_inverse[leg];
    M.noalias() -= X * J_B[leg];
    rhs_0.noalias() -= X * a_c[leg];
    rhs.middleCols<3>(at) = J_B[leg].transpose();
  }
  const Eigen::PartialPivLU<Mat6> lu(M);
  z_.trunk = lu.solve(rhs);
  z_.trunk_0 = lu.solve(rhs_0);
  for (const Leg leg : kLegs) {
    const int at = 3 * static_cast<int>(leg);
    if (in.legs.InContact(leg)) {
      z_.qdd[leg] = -J_inverse[leg] * (J_B[leg] * z_.trunk);
      z_.qdd_0[leg] = J_inverse[leg] * (a_c[leg] - J_B[leg] * z_.trunk_0);
    } else {
      z_.qdd[leg].setZero();
      z_.qdd[leg].middleCols<3>(at).setIdentity();
      z_.qdd_0[leg].setZero();
    }
    z_.tau[leg] = wb.H_Bl[leg].transpose() * z_.trunk + wb.H_ll[leg] * z_.qdd[leg];
    z_.tau_0[leg] =
        wb.H_Bl[leg].transpose() * z_.trunk_0 + wb.H_ll[leg] * z_.qdd_0[leg] + wb.h_l[leg];
    if (in.legs.InContact(leg)) z_.tau[leg].middleCols<3>(at) -= J[leg].transpose();
  }
}

void TsidNullspace::AddTask(const Mat3x12& A, const Vec3& target, double weight) noexcept {
  G_.noalias() += weight * A.transpose() * A;
  g_.noalias() -= weight * A.transpose() * target;
}

void TsidNullspace::AddTasks(const WbcInput& in, const BodyReference::Stage& target) noexcept {
  const core::WholeBody& wb = in.wb;
  G_ = params_.regularisation * Mat12::Identity();
  g_.setZero();

  // Feed-forward acceleration of the MPC's forces, and the COM's acceleration Σ f / m + g.
  const LegArray<Vec3> f_planned = in.forces.ForcesFor(in.legs.Contacts(), in.n_W);
  Vec3 f_sum = Vec3::Zero(), t_sum = Vec3::Zero();
  Mat3x12 com = Mat3x12::Zero();
  for (const Leg leg : kLegs) {
    if (!in.legs.InContact(leg)) continue;
    const int at = 3 * static_cast<int>(leg);
    com.middleCols<3>(at) = Mat3::Identity() / wb.mass_kg;
    const Vec3& f_desired = f_planned[leg];
    f_sum += f_desired;
    const Vec3 p_CP_W = wb.p_WF[leg] - robot_.legs[leg].foot_radius_m * in.n_W - wb.p_WC;
    t_sum += p_CP_W.cross(f_desired);
    G_.block<3, 3>(at, at).diagonal().array() += params_.force_weight;
    g_.segment<3>(at) -= params_.force_weight * f_desired;
  }
  const Vec3 a_com = f_sum / wb.mass_kg + params_.com_kp * (target.p_WC - wb.p_WC) +
                     params_.com_kd * (target.v_WC - wb.v_WC);  // gravity on both sides cancels
  AddTask(com, a_com, params_.com_weight);

  const Mat3 R_error = core::RotationFromRpy(target.rpy_rad) * wb.state.R_WB.transpose();
  const Vec3 alpha = wb.I_C_W.inverse() * t_sum + params_.orientation_kp * core::LogSo3(R_error) +
                     params_.orientation_kd * (target.w_WB - wb.state.w_WB);
  AddTask(z_.trunk.bottomRows<3>(), alpha - z_.trunk_0.tail<3>(), params_.orientation_weight);

  for (const Leg leg : kLegs) {
    if (in.legs.InContact(leg)) continue;
    const FootTarget& foot = in.feet[leg];
    Vec3 a = foot.a_WF + params_.swing_kp * (foot.p_WF - wb.p_WF[leg]) +
             params_.swing_kd * (foot.v_WF - wb.v_WF[leg]);
    if (a.norm() > params_.max_swing_acceleration_mps2) {
      a *= params_.max_swing_acceleration_mps2 / a.norm();
    }
    const Mat3 S = Skew(wb.p_BF_W[leg]);
    const Mat3x12 A =
        z_.trunk.topRows<3>() - S * z_.trunk.bottomRows<3>() + wb.J_ll[leg] * z_.qdd[leg];
    const Vec3 a_0 = z_.trunk_0.head<3>() - S * z_.trunk_0.tail<3>() +
                     wb.J_ll[leg] * z_.qdd_0[leg] + wb.Jd_v[leg];
    AddTask(A, a - a_0, params_.swing_weight);
  }
}

void TsidNullspace::BuildRows(const WbcInput& in, bool torque_limits) noexcept {
  const Mat3 R_WT = GroundFrame(in.n_W, core::RpyFromRotation(in.wb.state.R_WB).z());
  const Vec3 n = R_WT.col(2);
  Eigen::Index row = 0;
  A_.setZero(kMaxRows, kVars);
  b_.setZero(kMaxRows);
  for (const Leg leg : kLegs) {
    if (!in.legs.InContact(leg)) continue;
    const int at = 3 * static_cast<int>(leg);
    for (const Vec3& t : {Vec3(R_WT.col(0)), Vec3(R_WT.col(1))}) {
      A_.row(row++).segment<3>(at) = (params_.friction * n - t).transpose();
      A_.row(row++).segment<3>(at) = (params_.friction * n + t).transpose();
    }
    A_.row(row).segment<3>(at) = n.transpose();
    b_[row++] = params_.f_min_N;
  }
  if (torque_limits) {
    for (const Leg leg : kLegs) {
      for (int j = 0; j < kJointsPerLeg; ++j) {
        A_.row(row) = z_.tau[leg].row(j);
        b_[row++] = -effort_Nm_[leg][j] - z_.tau_0[leg][j];
        A_.row(row) = -z_.tau[leg].row(j);
        b_[row++] = -effort_Nm_[leg][j] + z_.tau_0[leg][j];
      }
    }
  }
  A_.conservativeResize(row, Eigen::NoChange);
  b_.conservativeResize(row);
}

WbcResult TsidNullspace::Solve(const WbcInput& in) noexcept {
  WbcResult result;
  result.target = Interpolate(in.forces, in.plan_age_s + params_.target_lead_s);
  Reduce(in);
  AddTasks(in, result.target);
  BuildRows(in, true);
  solver_.Solve(G_, g_, A_, b_, solution_);
  if (solution_.status != SolveStatus::kOptimal) {
    result.torque_rows_dropped = true;
    BuildRows(in, false);
    solver_.Solve(G_, g_, A_, b_, solution_);
  }
  result.status = solution_.status;
  result.iterations = solution_.iterations;
  if (result.status != SolveStatus::kOptimal ||
      !solution_.x.allFinite()) {  // unfinished dual iterates violate rows
    result.status = SolveStatus::kNumerical;
    return result;
  }
  const Vec12 z = solution_.x;
  for (const Leg leg : kLegs) {
    const Vec3 tau = z_.tau_0[leg] + z_.tau[leg] * z;
    result.command.tau_Nm[leg] = tau.cwiseMax(-effort_Nm_[leg]).cwiseMin(effort_Nm_[leg]);
    result.command.q[leg] = in.wb.state.q[leg];
    result.command.qd[leg] = in.wb.state.qd[leg];
    if (in.legs.InContact(leg)) result.f_F_W[leg] = z.segment<3>(3 * static_cast<int>(leg));
  }
  return result;
}

}  // namespace scoria::controller
