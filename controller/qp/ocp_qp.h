// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "controller/qp/status.h"
#include "core/robot/plans.h"

namespace scoria::controller {

/// Optimal control problem of the single-rigid-body MPC:
///   min  Σ_{k=0..N} ½ xₖᵀQₖxₖ + qₖᵀxₖ + Σ_{k<N} ½ uₖᵀRₖuₖ + rₖᵀuₖ
///   s.t. xₖ₊₁ = [1 F; 0 1] xₖ + Bₖuₖ + bₖ, x₀ given,
///        foot in stance: |fx| ≤ μ fz, |fy| ≤ μ fz, f_min ≤ fz ≤ f_max; in swing: f = 0.
/// x (12) = two 6-vectors of which the first integrates the second; u (12) = 4 x (fx, fy, fz) in N,
/// FL FR HL HR.
struct OcpStage {
  Mat6 F = Mat6::Zero();
  Mat12 B = Mat12::Zero();
  Vec12 b = Vec12::Zero();
  Vec12 Q = Vec12::Zero(), q = Vec12::Zero();  // diagonal of Q
  Vec12 R = Vec12::Zero(), r = Vec12::Zero();  // diagonal of R
  LegArray<bool> stance;
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
  double complementarity = 0.0;  // mean of slack times multiplier at the end
  std::array<Vec12, kMaxHorizon> u;
  std::array<Vec12, kMaxHorizon + 1> x;
};

/// Σ ½ xᵀQx + qᵀx + ½ uᵀRu + rᵀu of the trajectory that `u` produces from x₀.
[[nodiscard]] double CalcObjective(const OcpQp& qp,
                                   const std::array<Vec12, kMaxHorizon>& u) noexcept;

}  // namespace scoria::controller
