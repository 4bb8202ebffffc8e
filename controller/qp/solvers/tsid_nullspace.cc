// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/tsid_nullspace.h"

#include <Eigen/LU>

namespace scoria::controller {
namespace {

/// |det| over the cube of the Frobenius norm; a leg at ordinary poses has 0.05 to 0.19 of it, the
/// greatest possible, 3^-1.5.
constexpr double kSingular = 0.01;

bool IsSingular(const Mat3& J) noexcept {
  const double size = J.norm();
  return std::abs(J.determinant()) < kSingular * size * size * size;
}

}  // namespace

/// With q̈_l = J_l⁻¹(a_c − J_B a) in stance legs, the trunk's equation of motion becomes
///   (H_BB − Σ H_Bl K_l) a = Σ J_Bᵀ f_l − Σ_swing H_Bl q̈_l − h_B − Σ H_Bl k_l,   K = J⁻¹ J_B.
bool TsidNullspace::Reduce(const TsidProblem& p) noexcept {
  Mat6 M = p.H_BB;
  Eigen::Matrix<double, 6, 13> rhs;
  rhs.col(12) = -p.h_B;
  for (const Leg leg : kLegs) {
    const int at = 3 * static_cast<int>(leg);
    if (!p.stance[leg]) {
      rhs.middleCols<3>(at) = -p.H_Bl[leg];
      continue;
    }
    if (IsSingular(p.J[leg])) return false;
    const Mat3 J_inverse = p.J[leg].inverse();
    K_[leg] = J_inverse.lazyProduct(p.J_B[leg]);
    k_[leg] = J_inverse * p.a_c[leg];
    M -= p.H_Bl[leg].lazyProduct(K_[leg]);
    rhs.col(12) -= p.H_Bl[leg] * k_[leg];
    rhs.middleCols<3>(at) = p.J_B[leg].transpose();
  }
  const Eigen::Matrix<double, 6, 13> solved = M.partialPivLu().solve(rhs);
  T_ = solved.leftCols<12>();
  t_ = solved.col(12);
  for (const Leg leg : kLegs) {
    const int at = 3 * static_cast<int>(leg);
    Mat36 per_trunk = p.H_Bl[leg].transpose();  // dτ/da
    tau_0_[leg] = p.h_l[leg];
    if (p.stance[leg]) {
      per_trunk -= p.H_ll[leg].lazyProduct(K_[leg]);
      tau_0_[leg] += p.H_ll[leg] * k_[leg];
    }
    tau_[leg] = per_trunk.lazyProduct(T_);
    tau_0_[leg] += per_trunk * t_;
    if (p.stance[leg]) {
      tau_[leg].middleCols<3>(at) -= p.J[leg].transpose();
    } else {
      tau_[leg].middleCols<3>(at) += p.H_ll[leg];
    }
  }
  return true;
}

/// Cost of a and z once q̈ of stance legs is gone, then of z alone.
void TsidNullspace::ReduceCost(const TsidProblem& p) noexcept {
  Mat6 G_BB = p.G_BB;
  Vec6 g_B = p.g_B;
  G_ = p.G_ff;
  g_ = p.g_f;
  Eigen::Matrix<double, 6, 12> G_Bz = Eigen::Matrix<double, 6, 12>::Zero();
  for (const Leg leg : kLegs) {
    const int at = 3 * static_cast<int>(leg);
    if (p.stance[leg]) {
      const Mat63 cross = p.G_Bl[leg] - K_[leg].transpose().lazyProduct(p.G_ll[leg]);
      const Mat6 coupling = p.G_Bl[leg].lazyProduct(K_[leg]);
      G_BB -= cross.lazyProduct(K_[leg]) + coupling.transpose();
      g_B += cross * k_[leg] - K_[leg].transpose() * p.g_l[leg];
    } else {
      G_.block<12, 3>(0, at).setZero();
      G_.block<3, 12>(at, 0).setZero();
      G_.block<3, 3>(at, at) = p.G_ll[leg];
      g_.segment<3>(at) = p.g_l[leg];
      G_Bz.middleCols<3>(at) = p.G_Bl[leg];
    }
  }
  const Eigen::Matrix<double, 6, 12> W = G_BB.lazyProduct(T_) + G_Bz;
  G_ += T_.transpose().lazyProduct(W) + G_Bz.transpose().lazyProduct(T_);
  g_ += W.transpose() * t_ + T_.transpose() * g_B;
}

void TsidNullspace::BuildRows(const TsidProblem& p) noexcept {
  Eigen::Index row = 0;
  A_.resize(kMaxRows, kVars);
  b_.resize(kMaxRows);
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    A_.middleRows<5>(row).setZero();
    A_.block<5, 3>(row, 3 * static_cast<int>(leg)) = p.cone[leg];
    b_.segment<5>(row) = p.cone_min[leg];
    row += 5;
  }
  if (p.limit_torques) {
    for (const Leg leg : kLegs) {
      A_.middleRows<3>(row) = tau_[leg];
      b_.segment<3>(row) = p.tau_min[leg] - tau_0_[leg];
      A_.middleRows<3>(row + 3) = -tau_[leg];
      b_.segment<3>(row + 3) = tau_0_[leg] - p.tau_max[leg];
      row += 6;
    }
  }
  A_.conservativeResize(row, Eigen::NoChange);
  b_.conservativeResize(row);
}

TsidSolution TsidNullspace::Solve(const TsidProblem& p) noexcept {
  TsidSolution out;
  if (!Reduce(p)) {
    out.singular_leg = true;
    return out;
  }
  ReduceCost(p);
  BuildRows(p);
  solver_.Solve(G_, g_, A_, b_, result_);
  out.status = result_.status;
  out.iterations = result_.iterations;
  const Vec12 z = result_.x;
  out.a = T_ * z + t_;
  for (const Leg leg : kLegs) {
    const Vec3 part = z.segment<3>(3 * static_cast<int>(leg));
    if (p.stance[leg]) {
      out.f[leg] = part;
      out.qdd[leg] = k_[leg] - K_[leg] * out.a;
    } else {
      out.qdd[leg] = part;
    }
    out.tau[leg] = tau_[leg] * z + tau_0_[leg];
  }
  if (out.status != SolveStatus::kOptimal) return out;
  Eigen::Index row = 0;
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    out.of_cone[leg] = result_.multipliers.segment<5>(row);
    row += 5;
  }
  for (const Leg leg : kLegs) {
    if (!p.limit_torques) break;
    out.of_tau[leg] = result_.multipliers.segment<3>(row + 3) - result_.multipliers.segment<3>(row);
    row += 6;
  }
  return out;
}

}  // namespace scoria::controller
