// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/solvers/regulator.h"

namespace scoria::controller {

/// Regulator for forward Euler, where forces reach the state only through their 6-dimensional
/// wrench on the velocities. With P = [P₁₁ P₁₂; P₁₂ᵀ Λ] the cost-to-go, D = Λ⁻¹, K = D P₁₂ᵀ and
/// S = Σ B_f H_f⁻¹ B_fᵀ over the feet, minimising over all forces of a stage gives
///   Γ = (D + S)⁻¹,   X = [P₁₁ − P₁₂ K + KᵀΓK, KᵀΓ; ΓK, Γ],   P ← Q + AᵀXA:
/// two 6x6 inverses, however many feet stand. The costate of the velocities ν then gives every
/// force, u_f = −H_f⁻¹ (g_f + B_fᵀ ν). Source: Woodbury identity on the Riccati recursion.
class WrenchRegulator final : public Regulator {
 public:
  void Load(const OcpQp& qp, const FootIndex& feet) noexcept override;
  void Factorize(const OcpQp& qp, const FootIndex& feet,
                 const FootHessian& hessian) noexcept override;
  void Solve(const OcpQp& qp, const FootIndex& feet, const FootTable<3>& gradient,
             FootTrajectory& out) noexcept override;

 private:
  // Two idle rows make a column two registers wide.
  using Block = Eigen::Matrix<double, 8, 6>;
  using Column = Eigen::Matrix<double, 8, 1>;

  struct Stage {
    Block F, Ft, D, Kt, G, X, S;  // F, Fᵀ, D, Kᵀ, Γ, ΓK, S
    Column b_1, b_2, q_1, q_2, Pb_1, Pb_2;
    Column s0, nu0;
  };

  [[nodiscard]] static Block Invert(const Block& M) noexcept;
  void InvertHessians(const FootIndex& feet, const FootHessian& hessian) noexcept;
  void SumWrenches(const FootIndex& feet) noexcept;
  void SumGradients(const FootIndex& feet, const FootTable<3>& gradient) noexcept;
  void CalcForces(const FootIndex& feet, const FootTable<3>& gradient,
                  FootTable<3>& u) const noexcept;

  int horizon_ = 0;
  FootTable<18> B_;  // column 3 i + j: row i of the wrench, component j of the force
  FootTable<1> h11_, h22_, h33_, h12_, h13_, h23_;  // H⁻¹
  FootTable<18> BH_;
  FootTable<21> BHB_;
  FootTable<6> nu_;
  std::array<Stage, kMaxHorizon> stages_;
  Column q_end_1_, q_end_2_;
};

}  // namespace scoria::controller
