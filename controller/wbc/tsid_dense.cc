// SPDX-License-Identifier: BSD-3-Clause
#include "controller/wbc/tsid_dense.h"

namespace scoria::controller {
namespace {

constexpr int kTrunk = 6, kMotion = 18;

int JointsAt(Leg leg) noexcept { return kTrunk + kJointsPerLeg * static_cast<int>(leg); }

}  // namespace

void TsidDense::Size(const TsidProblem& p, bool torque_limits) noexcept {
  int variables = kMotion, stance = 0;
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    force_at_[leg] = variables;
    variables += 3;
    ++stance;
  }
  torque_at_ = variables;
  if (full_) variables += kNumJoints;
  const int equalities = (full_ ? kMotion : kTrunk) + 3 * stance;
  const int rows = 5 * stance + (torque_limits && !full_ ? kNumJoints : 0);
  qp_.H.setZero(variables, variables);
  qp_.g.setZero(variables);
  qp_.A.setZero(equalities, variables);
  qp_.b.setZero(equalities);
  qp_.C.setZero(rows, variables);
  qp_.l.setConstant(rows, -DenseQp::kNone);
  qp_.u.setConstant(rows, DenseQp::kNone);
  qp_.lb.setConstant(variables, -DenseQp::kNone);
  qp_.ub.setConstant(variables, DenseQp::kNone);
}

void TsidDense::AddCost(const TsidProblem& p) noexcept {
  qp_.H.topLeftCorner<6, 6>() = p.G_BB;
  qp_.g.head<6>() = p.g_B;
  for (const Leg leg : kLegs) {
    const int at = JointsAt(leg);
    qp_.H.block<6, 3>(0, at) = p.G_Bl[leg];
    qp_.H.block<3, 6>(at, 0) = p.G_Bl[leg].transpose();
    qp_.H.block<3, 3>(at, at) = p.G_ll[leg];
    qp_.g.segment<3>(at) = p.g_l[leg];
    if (!p.stance[leg]) continue;
    const int from = 3 * static_cast<int>(leg);
    qp_.g.segment<3>(force_at_[leg]) = p.g_f.segment<3>(from);
    for (const Leg other : kLegs) {
      if (!p.stance[other]) continue;
      qp_.H.block<3, 3>(force_at_[leg], force_at_[other]) =
          p.G_ff.block<3, 3>(from, 3 * static_cast<int>(other));
    }
  }
}

void TsidDense::AddMotion(const TsidProblem& p) noexcept {
  qp_.A.topLeftCorner<6, 6>() = p.H_BB;
  qp_.b.head<6>() = -p.h_B;
  int contact = full_ ? kMotion : kTrunk;
  for (const Leg leg : kLegs) {
    const int at = JointsAt(leg);
    qp_.A.block<6, 3>(0, at) = p.H_Bl[leg];
    if (full_) {
      qp_.A.block<3, 6>(at, 0) = p.H_Bl[leg].transpose();
      qp_.A.block<3, 3>(at, at) = p.H_ll[leg];
      qp_.A.block<3, 3>(at, torque_at_ + at - kTrunk) = -Mat3::Identity();
      qp_.b.segment<3>(at) = -p.h_l[leg];
    }
    if (!p.stance[leg]) continue;
    qp_.A.block<6, 3>(0, force_at_[leg]) = -p.J_B[leg].transpose();
    if (full_) qp_.A.block<3, 3>(at, force_at_[leg]) = -p.J[leg].transpose();
    qp_.A.block<3, 6>(contact, 0) = p.J_B[leg];
    qp_.A.block<3, 3>(contact, at) = p.J[leg];
    qp_.b.segment<3>(contact) = p.a_c[leg];
    contact += 3;
  }
}

void TsidDense::AddLimits(const TsidProblem& p, bool torque_limits) noexcept {
  int row = 0;
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    qp_.C.block<5, 3>(row, force_at_[leg]) = p.cone[leg];
    qp_.l.segment<5>(row) = p.cone_min[leg];
    row += 5;
  }
  if (!torque_limits) return;
  for (const Leg leg : kLegs) {
    const int at = JointsAt(leg);
    if (full_) {
      qp_.lb.segment<3>(torque_at_ + at - kTrunk) = p.tau_min[leg];
      qp_.ub.segment<3>(torque_at_ + at - kTrunk) = p.tau_max[leg];
      continue;
    }
    qp_.C.block<3, 6>(row, 0) = p.H_Bl[leg].transpose();
    qp_.C.block<3, 3>(row, at) = p.H_ll[leg];
    if (p.stance[leg]) qp_.C.block<3, 3>(row, force_at_[leg]) = -p.J[leg].transpose();
    qp_.l.segment<3>(row) = p.tau_min[leg] - p.h_l[leg];
    qp_.u.segment<3>(row) = p.tau_max[leg] - p.h_l[leg];
    row += 3;
  }
}

TsidSolution TsidDense::Solve(const TsidProblem& p, bool torque_limits) noexcept {
  Size(p, torque_limits);
  AddCost(p);
  AddMotion(p);
  AddLimits(p, torque_limits);
  solver_.Solve(qp_, solution_);
  TsidSolution out;
  out.status = solution_.status;
  out.iterations = solution_.iterations;
  const auto& z = solution_.z;
  out.a = z.head<6>();
  for (const Leg leg : kLegs) {
    out.qdd[leg] = z.segment<3>(JointsAt(leg));
    if (p.stance[leg]) out.f[leg] = z.segment<3>(force_at_[leg]);
  }
  CompleteSolution(p, out);
  int row = 0;
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    out.of_cone[leg] = -solution_.of_rows.segment<5>(row);
    row += 5;
  }
  for (const Leg leg : kLegs) {
    if (full_) {
      out.of_tau[leg] = solution_.of_bounds.segment<3>(torque_at_ + JointsAt(leg) - kTrunk);
    } else if (torque_limits) {
      out.of_tau[leg] = solution_.of_rows.segment<3>(row);
      row += 3;
    }
  }
  return out;
}

}  // namespace scoria::controller
