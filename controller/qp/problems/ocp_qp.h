// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "controller/qp/status.h"
#include "core/robot/plans.h"

namespace scoria::controller {

/// Optimal control problem of the single-rigid-body MPC:
///   min  Σ_{k=0..N} ½ xₖᵀQₖxₖ + qₖᵀxₖ + Σ_{k<N} ½ uₖᵀRₖuₖ + rₖᵀuₖ
///   s.t. xₖ₊₁ = [1 F; 0 1] xₖ + Bₖuₖ + bₖ, F = [E 0; 0 dt 1], x₀ given,
///        foot in stance: |fx| ≤ μ fz, |fy| ≤ μ fz, f_min ≤ fz ≤ f_max; in swing: f = 0.
/// x (12) = [angles; position; angular velocity; velocity], the first half integrates the second;
/// u (12) = 4 x (fx, fy, fz) in N, FL FR HL HR. Q is positive in the second half.
struct OcpStage {
  Mat3 E = Mat3::Zero();  // change of the angles over the stage per angular velocity, s
  double dt_s = 0.0;
  Mat12 B = Mat12::Zero();
  Vec12 b = Vec12::Zero();
  Vec12 Q = Vec12::Zero(), q = Vec12::Zero();  // diagonal of Q
  Vec12 R = Vec12::Zero(), r = Vec12::Zero();  // diagonal of R
  LegArray<bool> stance;

  /// [1 F; 0 1] x.
  [[nodiscard]] Vec12 Drift(const Vec12& x) const noexcept {
    Vec12 next = x;
    next.head<3>() += E * x.segment<3>(6);
    next.segment<3>(3) += dt_s * x.tail<3>();
    return next;
  }
  [[nodiscard]] Mat12 DriftMatrix() const noexcept {
    Mat12 A = Mat12::Identity();
    A.block<3, 3>(0, 6) = E;
    A.block<3, 3>(3, 9) = dt_s * Mat3::Identity();
    return A;
  }
  /// [1 F; 0 1]ᵀ p.
  [[nodiscard]] Vec12 DriftTransposed(const Vec12& p) const noexcept {
    Vec12 before = p;
    before.segment<3>(6) += E.transpose() * p.head<3>();
    before.tail<3>() += dt_s * p.segment<3>(3);
    return before;
  }
};

struct OcpQp {
  int horizon = 0;
  Vec12 x0 = Vec12::Zero();
  std::array<OcpStage, kMaxHorizon + 1> stages;  // the last one uses only Q and q
  double friction = 0.5;
  double f_min_N = 0.0, f_max_N = 0.0;
  double start_force_N = 0.0;  // total normal force of the starting guess
  bool forward_euler = true;   // rows 0..5 of every B are zero
};

struct OcpSolution {
  SolveStatus status = SolveStatus::kNumerical;
  int iterations = 0;
  double relative_gap = 0.0;  // Σ slack x multiplier over the tracking cost, at the end
  std::array<Vec12, kMaxHorizon> u;
  std::array<Vec12, kMaxHorizon + 1> x;
  /// Multipliers of the rows of CalcForceLimits.
  std::array<LegArray<Vec6>, kMaxHorizon> lambda;
};

/// fx − μ fz, −fx − μ fz, fy − μ fz, −fy − μ fz, f_min − fz, fz − f_max of a stance foot's force:
/// all ≤ 0.
[[nodiscard]] Vec6 CalcForceLimits(const OcpQp& qp, const Vec3& f) noexcept;

/// The largest violation of the force limits, and largest force of a foot in the air, in N.
[[nodiscard]] double CalcViolation(const OcpQp& qp,
                                   const std::array<Vec12, kMaxHorizon>& u) noexcept;

/// Σ ½ xᵀQx + qᵀx + ½ uᵀRu + rᵀu of the trajectory that `u` produces from x₀.
[[nodiscard]] double CalcObjective(const OcpQp& qp,
                                   const std::array<Vec12, kMaxHorizon>& u) noexcept;

/// Gaps are relative to the tracking cost, but to no less than this.
inline constexpr double kLeastTrackingCost = 1e-3;

/// What CalcObjective lacks to the tracking cost Σ ½ (x − x_ref)ᵀQ(x − x_ref) + ..., which is ≥ 0.
[[nodiscard]] double CalcTrackingOffset(const OcpQp& qp) noexcept;

}  // namespace scoria::controller
