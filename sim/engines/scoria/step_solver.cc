// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/scoria/step_solver.h"

#include <algorithm>
#include <cmath>

#include "core/demand.h"
#include "core/math/cholesky.h"
#include "sim/plant/joint_limit.h"

namespace scoria::sim {
namespace {

Eigen::Index FirstDof(Leg leg) { return 6 + kJointsPerLeg * static_cast<Eigen::Index>(leg); }

/// A unit vector square to n, the same for neighbouring n.
Vec3 Tangent(const Vec3& n) {
  const Vec3 axis = std::abs(n.x()) < 0.7 ? Vec3::UnitX() : Vec3::UnitY();
  return (axis - n * n.dot(axis)).normalized();
}

}  // namespace

StepSolver::StepSolver(const core::RobotDescription& robot, const SolverParams& params)
    : robot_(robot), params_(params) {}

Vec18 StepSolver::Solve(const StepInput& in, std::span<ContactPoint> contacts) {
  const core::WholeBody& wb = in.wb;
  const double dt_s = in.dt_s;
  Factorize(wb, dt_s);
  Vec18 v_before, impulse;
  v_before.head<6>() << wb.state.v_WB, wb.state.w_WB;
  impulse.head<6>() = dt_s * (in.wrench_B_W - wb.h_B);
  for (const Leg leg : kLegs) {
    const Vec3& qd = wb.state.qd[leg];
    v_before.segment<3>(FirstDof(leg)) = qd;
    impulse.segment<3>(FirstDof(leg)) =
        dt_s *
        (in.tau_Nm[leg] - wb.h_l[leg] - robot_.config.motors.damping_Nms_per_rad.cwiseProduct(qd));
  }
  const Whitened before = ToWhitened(v_before), change = SolveLower(impulse);
  v_.trunk = before.trunk + change.trunk;
  for (const Leg leg : kLegs) v_.legs[leg] = before.legs[leg] + change.legs[leg];

  CollectRows(wb, contacts, dt_s);
  Iterate();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    ContactPoint& c = contacts[i];
    const ContactRows& rows = contacts_[i];
    const Vec3 tangent1_W = Tangent(c.n_W), tangent2_W = c.n_W.cross(tangent1_W);
    c.impulse_W = rows.normal.impulse * c.n_W + rows.tangent1.impulse * tangent1_W +
                  rows.tangent2.impulse * tangent2_W;
    c.v_W = Velocity(rows.normal, v_) * c.n_W + Velocity(rows.tangent1, v_) * tangent1_W +
            Velocity(rows.tangent2, v_) * tangent2_W;
  }
  for (std::size_t j = 0; j < kNumJoints; ++j) friction_guess_[j] = joints_[j].row.impulse;
  return FromWhitened(v_);
}

void StepSolver::Factorize(const core::WholeBody& wb, double dt_s) {
  L_BB_ = wb.H_BB;
  bool positive = true;
  for (const Leg leg : kLegs) {
    L_ll_[leg] = wb.H_ll[leg];
    L_ll_[leg].diagonal() += dt_s * robot_.config.motors.damping_Nms_per_rad;
    positive = core::FactorCholesky<3>(L_ll_[leg]) && positive;
    Eigen::Matrix<double, 3, 6, Eigen::RowMajor> B = wb.H_Bl[leg].transpose();
    core::SolveLower<3, 6>(L_ll_[leg], B);
    L_Bl_[leg] = B.transpose();
    L_BB_.noalias() -= L_Bl_[leg].lazyProduct(L_Bl_[leg].transpose());
  }
  positive = core::FactorCholesky<6>(L_BB_) && positive;
  SCORIA_DEMAND(positive, "mass matrix is not positive definite at height {} m", wb.state.p_WB.z());
}

StepSolver::Whitened StepSolver::ToWhitened(const Vec18& v) const noexcept {
  Whitened out;
  for (int i = 0; i < 6; ++i) {
    out.trunk[i] = v[i] / L_BB_(i, i);
    for (int k = i + 1; k < 6; ++k) out.trunk[i] += L_BB_(k, i) * v[k];
  }
  for (const Leg leg : kLegs) {
    const Mat3& L = L_ll_[leg];
    const Vec3 qd = v.segment<3>(FirstDof(leg));
    const Vec3 coupling = L_Bl_[leg].transpose() * v.head<6>();
    out.legs[leg] << qd[0] / L(0, 0) + L(1, 0) * qd[1] + L(2, 0) * qd[2] + coupling[0],
        qd[1] / L(1, 1) + L(2, 1) * qd[2] + coupling[1], qd[2] / L(2, 2) + coupling[2], 0.0;
  }
  return out;
}

Vec18 StepSolver::FromWhitened(const Whitened& v) const noexcept {
  Vec6 trunk = v.trunk.head<6>();
  core::SolveLowerTransposed<6>(L_BB_, trunk);
  Vec18 out;
  out.head<6>() = trunk;
  for (const Leg leg : kLegs) {
    Vec3 qd = v.legs[leg].head<3>() - L_Bl_[leg].transpose() * trunk;
    core::SolveLowerTransposed<3>(L_ll_[leg], qd);
    out.segment<3>(FirstDof(leg)) = qd;
  }
  return out;
}

StepSolver::Whitened StepSolver::SolveLower(const Vec18& impulse) const noexcept {
  Whitened out;
  Vec6 trunk = impulse.head<6>();
  for (const Leg leg : kLegs) {
    Vec3 own = impulse.segment<3>(FirstDof(leg));
    core::SolveLower<3, 1>(L_ll_[leg], own);
    trunk -= L_Bl_[leg] * own;
    out.legs[leg].head<3>() = own;
  }
  core::SolveLower<6, 1>(L_BB_, trunk);
  out.trunk.head<6>() = trunk;
  return out;
}

StepSolver::Row StepSolver::MakeRow(Leg leg, const Vec3& J_leg,
                                    const Vec6& J_trunk) const noexcept {
  Row row;
  row.leg = leg;
  Vec3 own = J_leg;
  core::SolveLower<3, 1>(L_ll_[leg], own);
  Vec6 trunk = J_trunk - L_Bl_[leg] * own;
  core::SolveLower<6, 1>(L_BB_, trunk);
  row.own.head<3>() = own;
  row.trunk.head<6>() = trunk;
  row.inverse_diagonal = 1.0 / (own.squaredNorm() + trunk.squaredNorm());
  return row;
}

double StepSolver::Velocity(const Row& row, const Whitened& v) noexcept {
  return row.trunk.dot(v.trunk) + row.own.dot(v.legs[row.leg]);
}

void StepSolver::Apply(const Row& row, double impulse, Whitened& v) noexcept {
  v.trunk += impulse * row.trunk;
  v.legs[row.leg] += impulse * row.own;
}

StepSolver::ContactRows StepSolver::MakeContact(const core::WholeBody& wb, const ContactPoint& c,
                                                double dt_s) const noexcept {
  const bool on_leg = c.body > 0;
  const Leg leg = on_leg ? kLegs[static_cast<std::size_t>((c.body - 1) / kJointsPerLeg)] : Leg::kFL;
  const int moving_joints = on_leg ? 1 + (c.body - 1) % kJointsPerLeg : 0;
  const auto along_direction = [&](const Vec3& d_W) {
    Vec3 J_leg = Vec3::Zero();
    for (int j = 0; j < moving_joints; ++j) {
      const Vec3 z_W = wb.Jw_ll[leg].col(j), r_W = c.p_BP_W - wb.p_BJ_W[leg].col(j);
      J_leg[j] = d_W.dot(z_W.cross(r_W));
    }
    Vec6 J_trunk;
    J_trunk << d_W, c.p_BP_W.cross(d_W);
    return MakeRow(leg, J_leg, J_trunk);
  };
  const Vec3 tangent1_W = Tangent(c.n_W), tangent2_W = c.n_W.cross(tangent1_W);
  ContactRows rows{along_direction(c.n_W),
                   along_direction(tangent1_W),
                   along_direction(tangent2_W),
                   tangent1_W,
                   tangent2_W,
                   c.friction};

  // Spring and damper at the end of the step: λ = dt (k (s − v dt) − c v), s the compression now.
  // The damper sets in with the ground.
  Row& normal = rows.normal;
  const double compression_m = -c.gap_m - c.rest_m;
  const double damping = compression_m > 0.0 ? c.damping_Ns_per_m : 0.0;
  const double grip = c.stiffness_N_per_m * dt_s + damping;
  normal.softness = 1.0 / (dt_s * grip);
  normal.target = c.stiffness_N_per_m * compression_m / grip;
  normal.inverse_diagonal = 1.0 / (1.0 / normal.inverse_diagonal + normal.softness);
  normal.impulse = std::max(0.0, c.n_W.dot(c.impulse_W));

  // One step length for both tangents, the largest eigenvalue of their 2x2 block: so that the
  // force of a sliding foot is exactly against its motion.
  const double a = 1.0 / rows.tangent1.inverse_diagonal, b = 1.0 / rows.tangent2.inverse_diagonal;
  const double coupling =
      rows.tangent1.trunk.dot(rows.tangent2.trunk) + rows.tangent1.own.dot(rows.tangent2.own);
  const double largest = 0.5 * (a + b) + std::hypot(0.5 * (a - b), coupling);
  const double softness =
      c.shear_stiffness_N_per_m > 0.0 ? 1.0 / (c.shear_stiffness_N_per_m * dt_s * dt_s) : 0.0;
  for (const auto& [row, d_W] :
       {std::pair{&rows.tangent1, &tangent1_W}, {&rows.tangent2, &tangent2_W}}) {
    row->softness = softness;
    row->target = softness > 0.0 ? -d_W->dot(c.shear_W) / dt_s : 0.0;
    row->inverse_diagonal = 1.0 / (largest + softness);
    row->impulse = d_W->dot(c.impulse_W);
  }
  return rows;
}

void StepSolver::CollectRows(const core::WholeBody& wb, std::span<const ContactPoint> contacts,
                             double dt_s) {
  contacts_.clear();
  joints_.clear();
  for (const ContactPoint& c : contacts) {
    contacts_.push_back(MakeContact(wb, c, dt_s));
    const ContactRows& rows = contacts_.back();
    for (const Row* row : {&rows.normal, &rows.tangent1, &rows.tangent2})
      Apply(*row, row->impulse, v_);
  }
  const Vec3 friction_Ns = dt_s * robot_.config.motors.friction_Nm;
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      JointRow friction{MakeRow(leg, Vec3::Unit(j), Vec6::Zero()), j, -friction_Ns[j],
                        friction_Ns[j]};
      friction.row.impulse =
          std::clamp(friction_guess_[joints_.size()], -friction_Ns[j], friction_Ns[j]);
      Apply(friction.row, friction.row.impulse, v_);
      joints_.push_back(friction);
    }
  }
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) AddLimits(leg, j, wb.state, dt_s);
  }
}

void StepSolver::AddLimits(Leg leg, int j, const RobotState& state, double dt_s) {
  constexpr double kUnlimited_Ns = 1e9;
  const core::JointDescription& joint = robot_.legs[leg].joints[static_cast<std::size_t>(j)];
  const double q = state.q[leg][j], qd = state.qd[leg][j];
  if (const auto retreat = CalcLeastRetreat(q - joint.lower_rad, qd, dt_s)) {
    joints_.push_back({MakeRow(leg, Vec3::Unit(j), Vec6::Zero()), j, 0.0, kUnlimited_Ns});
    joints_.back().row.target = *retreat;
  }
  if (const auto retreat = CalcLeastRetreat(joint.upper_rad - q, qd, dt_s)) {
    joints_.push_back({MakeRow(leg, Vec3::Unit(j), Vec6::Zero()), j, -kUnlimited_Ns, 0.0});
    joints_.back().row.target = -*retreat;
  }
}

void StepSolver::Iterate() {
  for (iterations_ = 0; iterations_ < params_.max_iterations; ++iterations_) {
    double worst = 0.0;
    for (ContactRows& c : contacts_) worst = std::max(worst, SolveContact(c));
    for (JointRow& j : joints_) worst = std::max(worst, SolveJoint(j));
    if (worst * worst < params_.residual) break;
  }
}

/// @returns the largest velocity by which an impulse was corrected.
double StepSolver::SolveContact(ContactRows& c) noexcept {
  const auto correction = [this](const Row& row) {
    return row.target - Velocity(row, v_) - row.softness * row.impulse;
  };
  Row& n = c.normal;
  const double normal = std::max(0.0, n.impulse + n.inverse_diagonal * correction(n));
  const double normal_change = normal - n.impulse;
  Apply(n, normal_change, v_);
  n.impulse = normal;

  double tangent1 = c.tangent1.impulse + c.tangent1.inverse_diagonal * correction(c.tangent1);
  double tangent2 = c.tangent2.impulse + c.tangent2.inverse_diagonal * correction(c.tangent2);
  const double size = std::hypot(tangent1, tangent2), limit = c.friction * normal;
  if (size > limit) {
    tangent1 *= limit / size;
    tangent2 *= limit / size;
  }
  const double change1 = tangent1 - c.tangent1.impulse, change2 = tangent2 - c.tangent2.impulse;
  Apply(c.tangent1, change1, v_);
  Apply(c.tangent2, change2, v_);
  c.tangent1.impulse = tangent1;
  c.tangent2.impulse = tangent2;
  return std::max(std::abs(normal_change) / n.inverse_diagonal,
                  std::hypot(change1, change2) / c.tangent1.inverse_diagonal);
}

double StepSolver::SolveJoint(JointRow& j) noexcept {
  const double free = j.row.impulse + j.row.inverse_diagonal * (j.row.target - Velocity(j.row, v_));
  const double impulse = std::clamp(free, j.low_Ns, j.high_Ns);
  const double change = impulse - j.row.impulse;
  Apply(j.row, change, v_);
  j.row.impulse = impulse;
  return std::abs(change) / j.row.inverse_diagonal;
}

LegArray<Vec3> StepSolver::JointImpulses() const noexcept {
  LegArray<Vec3> impulses = ZeroPerLeg();
  for (const JointRow& j : joints_) impulses[j.row.leg][j.joint] += j.row.impulse;
  return impulses;
}

}  // namespace scoria::sim
