// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/status.h"
#include "core/math/types.h"
#include "core/robot/legs.h"

namespace scoria::controller {

/// Whole-body control of one tick as a quadratic program in blocks of trunk and legs. Unknowns:
/// trunk acceleration a (6), joint accelerations q̈_l (3 per leg), forces f_l of stance feet (3),
/// torques τ_l (3 per leg), all in W.
///   min  ½ aᵀG_BB a + g_Bᵀa + Σ (aᵀG_Bl q̈_l + ½ q̈_lᵀG_ll q̈_l + g_lᵀq̈_l) + ½ fᵀG_ff f + g_fᵀf
///   s.t. H_BB a + Σ H_Bl q̈_l + h_B = Σ J_Blᵀ f_l
///        H_Blᵀ a + H_ll q̈_l + h_l = τ_l + J_lᵀ f_l
///        J_Bl a + J_l q̈_l = a_c,l                                    stance feet
///        cone_l f_l ≥ cone_min_l                                      stance feet
///        τ_min ≤ τ ≤ τ_max                                            with limit_torques.
struct TsidProblem {
  static constexpr int kConeRows = 5;
  using Mat36 = Eigen::Matrix<double, 3, 6>;
  using Cone = Eigen::Matrix<double, kConeRows, 3>;
  using Vec5 = Eigen::Matrix<double, kConeRows, 1>;

  LegArray<bool> stance;
  Mat6 H_BB = Mat6::Zero();
  Vec6 h_B = Vec6::Zero();
  LegArray<Mat63> H_Bl;
  LegArray<Mat3> H_ll;
  LegArray<Vec3> h_l;
  LegArray<Mat36> J_B;
  LegArray<Mat3> J;
  LegArray<Vec3> a_c;

  Mat6 G_BB = Mat6::Zero();
  Vec6 g_B = Vec6::Zero();
  LegArray<Mat63> G_Bl;
  LegArray<Mat3> G_ll;
  LegArray<Vec3> g_l;
  Mat12 G_ff = Mat12::Zero();  // rows and columns 3 l to 3 l + 2 of stance feet count
  Vec12 g_f = Vec12::Zero();

  LegArray<Cone> cone;
  LegArray<Vec5> cone_min;
  LegArray<Vec3> tau_min, tau_max;
  bool limit_torques = true;
};

struct TsidSolution {
  SolveStatus status = SolveStatus::kNumerical;
  int iterations = 0;
  bool singular_leg = false;
  Vec6 a = Vec6::Zero();
  LegArray<Vec3> qdd = ZeroPerLeg(), f = ZeroPerLeg(), tau = ZeroPerLeg();
  // Multipliers: of the cones; of the torques, positive at the upper limit, negative at the lower.
  LegArray<TsidProblem::Vec5> of_cone{TsidProblem::Vec5::Zero()};
  LegArray<Vec3> of_tau = ZeroPerLeg();
};

/// A problem as it was solved.
struct TsidRecord {
  TsidProblem problem;
  TsidSolution solution;
};

/// τ of every leg, from a, q̈ and the forces.
[[nodiscard]] LegArray<Vec3> CalcTorques(const TsidProblem& problem,
                                         const TsidSolution& solution) noexcept;

}  // namespace scoria::controller
