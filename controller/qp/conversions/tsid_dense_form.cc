// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/conversions/tsid_dense_form.h"

namespace scoria::controller {
namespace {

void Clear(const TsidLayout& at, DenseQp& qp) noexcept {
  qp.H.setZero(at.variables, at.variables);
  qp.g.setZero(at.variables);
  qp.A.setZero(at.equalities, at.variables);
  qp.b.setZero(at.equalities);
  qp.C.setZero(at.rows, at.variables);
  qp.l.setConstant(at.rows, -DenseQp::kUnbounded);
  qp.u.setConstant(at.rows, DenseQp::kUnbounded);
  qp.lb.setConstant(at.variables, -DenseQp::kUnbounded);
  qp.ub.setConstant(at.variables, DenseQp::kUnbounded);
}

void AddCost(const TsidProblem& p, const TsidLayout& at, DenseQp& qp) noexcept {
  constexpr double kIdle = 1e-8;  // of the force of a foot in the air
  qp.H.topLeftCorner<6, 6>() = p.G_BB;
  qp.g.head<6>() = p.g_B;
  for (const Leg leg : kLegs) {
    const int joints = TsidLayout::joints(leg);
    qp.H.block<6, 3>(0, joints) = p.G_Bl[leg];
    qp.H.block<3, 6>(joints, 0) = p.G_Bl[leg].transpose();
    qp.H.block<3, 3>(joints, joints) = p.G_ll[leg];
    qp.g.segment<3>(joints) = p.g_l[leg];
    if (!p.stance[leg]) {
      if (at.idle_forces) qp.H.block<3, 3>(at.force[leg], at.force[leg]) = kIdle * Mat3::Identity();
      continue;
    }
    const int from = 3 * static_cast<int>(leg);
    qp.g.segment<3>(at.force[leg]) = p.g_f.segment<3>(from);
    for (const Leg other : kLegs) {
      if (!p.stance[other]) continue;
      qp.H.block<3, 3>(at.force[leg], at.force[other]) =
          p.G_ff.block<3, 3>(from, 3 * static_cast<int>(other));
    }
  }
}

void AddMotion(const TsidProblem& p, const TsidLayout& at, DenseQp& qp) noexcept {
  qp.A.topLeftCorner<6, 6>() = p.H_BB;
  qp.b.head<6>() = -p.h_B;
  for (const Leg leg : kLegs) {
    const int joints = TsidLayout::joints(leg);
    qp.A.block<6, 3>(0, joints) = p.H_Bl[leg];
    if (at.full) {
      qp.A.block<3, 6>(joints, 0) = p.H_Bl[leg].transpose();
      qp.A.block<3, 3>(joints, joints) = p.H_ll[leg];
      qp.A.block<3, 3>(joints, at.torque[leg]) = -Mat3::Identity();
      qp.b.segment<3>(joints) = -p.h_l[leg];
    }
    if (!p.stance[leg]) continue;
    qp.A.block<6, 3>(0, at.force[leg]) = -p.J_B[leg].transpose();
    if (at.full) qp.A.block<3, 3>(joints, at.force[leg]) = -p.J[leg].transpose();
    qp.A.block<3, 6>(at.contact[leg], 0) = p.J_B[leg];
    qp.A.block<3, 3>(at.contact[leg], joints) = p.J[leg];
    qp.b.segment<3>(at.contact[leg]) = p.a_c[leg];
  }
}

void AddTorqueLimits(const TsidProblem& p, const TsidLayout& at, DenseQp& qp) noexcept {
  for (const Leg leg : kLegs) {
    const int joints = TsidLayout::joints(leg);
    if (at.full && p.limit_torques) {
      qp.lb.segment<3>(at.torque[leg]) = p.tau_min[leg];
      qp.ub.segment<3>(at.torque[leg]) = p.tau_max[leg];
    }
    if (!at.torque_rows) continue;
    const int row = at.torque[leg];
    qp.C.block<3, 6>(row, 0) = p.H_Bl[leg].transpose();
    qp.C.block<3, 3>(row, joints) = p.H_ll[leg];
    if (p.stance[leg]) qp.C.block<3, 3>(row, at.force[leg]) = -p.J[leg].transpose();
    if (!p.limit_torques) continue;
    qp.l.segment<3>(row) = p.tau_min[leg] - p.h_l[leg];
    qp.u.segment<3>(row) = p.tau_max[leg] - p.h_l[leg];
  }
}

void ReadLeg(const DenseQp& qp, const TsidLayout& at, Leg leg, TsidProblem& p) noexcept {
  const int joints = TsidLayout::joints(leg), torque = at.torque[leg];
  p.H_Bl[leg] = qp.A.block<6, 3>(0, joints);
  p.G_Bl[leg] = qp.H.block<6, 3>(0, joints);
  p.G_ll[leg] = qp.H.block<3, 3>(joints, joints);
  p.g_l[leg] = qp.g.segment<3>(joints);
  if (at.full) {
    p.H_ll[leg] = qp.A.block<3, 3>(joints, joints);
    p.h_l[leg] = -qp.b.segment<3>(joints);
    p.tau_min[leg] = qp.lb.segment<3>(torque);
    p.tau_max[leg] = qp.ub.segment<3>(torque);
  } else {
    p.H_ll[leg] = qp.C.block<3, 3>(torque, joints);
    p.h_l[leg].setZero();
    p.tau_min[leg] = qp.l.segment<3>(torque);
    p.tau_max[leg] = qp.u.segment<3>(torque);
  }
}

void ReadContact(const DenseQp& qp, const TsidLayout& at, Leg leg, TsidProblem& p) noexcept {
  p.J_B[leg] = qp.A.block<3, 6>(at.contact[leg], 0);
  p.J[leg] = qp.A.block<3, 3>(at.contact[leg], TsidLayout::joints(leg));
  p.a_c[leg] = qp.b.segment<3>(at.contact[leg]);
  p.cone[leg].setZero();
  p.cone_min[leg].setConstant(-1.0);
  for (int i = 0; i < at.cone_rows; ++i) {
    const int row = at.cone[leg] + i;
    const bool low = qp.l[row] > -DenseQp::kNone;
    const Vec3 side = qp.C.block<1, 3>(row, at.force[leg]).transpose();
    p.cone[leg].row(i) = (low ? side : Vec3(-side)).transpose();
    p.cone_min[leg][i] = low ? qp.l[row] : -qp.u[row];
  }
}

}  // namespace

void ToDense(const TsidProblem& p, const TsidLayout& at, DenseQp& out) noexcept {
  Clear(at, out);
  AddCost(p, at, out);
  AddMotion(p, at, out);
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    out.C.block<TsidProblem::kConeRows, 3>(at.cone[leg], at.force[leg]) = p.cone[leg];
    out.l.segment<TsidProblem::kConeRows>(at.cone[leg]) = p.cone_min[leg];
  }
  AddTorqueLimits(p, at, out);
}

TsidProblem FromDense(const DenseQp& qp, const TsidLayout& at) noexcept {
  TsidProblem p;
  p.stance = at.stance;
  p.H_BB = qp.A.topLeftCorner<6, 6>();
  p.h_B = -qp.b.head<6>();
  p.G_BB = qp.H.topLeftCorner<6, 6>();
  p.g_B = qp.g.head<6>();
  for (const Leg leg : kLegs) {
    ReadLeg(qp, at, leg, p);
    if (!p.stance[leg]) continue;
    ReadContact(qp, at, leg, p);
    const int to = 3 * static_cast<int>(leg);
    p.g_f.segment<3>(to) = qp.g.segment<3>(at.force[leg]);
    for (const Leg other : kLegs) {
      if (!p.stance[other]) continue;
      p.G_ff.block<3, 3>(to, 3 * static_cast<int>(other)) =
          qp.H.block<3, 3>(at.force[leg], at.force[other]);
    }
  }
  return p;
}

TsidSolution FromDense(const DenseSolutionView& s, const TsidProblem& p,
                       const TsidLayout& at) noexcept {
  TsidSolution out;
  out.status = s.status;
  out.iterations = s.iterations;
  out.a = s.z.head<6>();
  for (const Leg leg : kLegs) {
    out.qdd[leg] = s.z.segment<3>(TsidLayout::joints(leg));
    if (p.stance[leg]) out.f[leg] = s.z.segment<3>(at.force[leg]);
  }
  out.tau = CalcTorques(p, out);
  for (const Leg leg : kLegs) {
    if (p.stance[leg])
      out.of_cone[leg].head(at.cone_rows) = -s.of_rows.segment(at.cone[leg], at.cone_rows);
    if (at.full) out.of_tau[leg] = s.of_bounds.segment<3>(at.torque[leg]);
    if (at.torque_rows) out.of_tau[leg] = s.of_rows.segment<3>(at.torque[leg]);
  }
  return out;
}

DenseSolution ToDense(const TsidSolution& s, const TsidLayout& at) noexcept {
  DenseSolution out;
  out.status = s.status;
  out.iterations = s.iterations;
  out.z.setZero(at.variables);
  out.of_rows.setZero(at.rows);
  out.of_bounds.setZero(at.variables);
  out.z.head<6>() = s.a;
  for (const Leg leg : kLegs) {
    out.z.segment<3>(TsidLayout::joints(leg)) = s.qdd[leg];
    if (at.full) {
      out.z.segment<3>(at.torque[leg]) = s.tau[leg];
      out.of_bounds.segment<3>(at.torque[leg]) = s.of_tau[leg];
    }
    if (at.torque_rows) out.of_rows.segment<3>(at.torque[leg]) = s.of_tau[leg];
    if (!at.stance[leg]) continue;
    out.z.segment<3>(at.force[leg]) = s.f[leg];
    out.of_rows.segment<TsidProblem::kConeRows>(at.cone[leg]) = -s.of_cone[leg];
  }
  return out;
}

}  // namespace scoria::controller
