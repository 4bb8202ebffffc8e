// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/problems/dense_qp.h"
#include "controller/qp/problems/ocp_qp.h"

namespace scoria::controller {

/// How far a point is from meeting the Karush-Kuhn-Tucker conditions of its problem. Forces in N;
/// stationarity, in cost per N for an OcpQp, relative to max(1, largest term).
struct KktResidual {
  double primal = 0.0;           // dynamics or equalities, and limits
  double dual = 0.0;             // multipliers of the wrong sign
  double stationarity = 0.0;     // gradient of the Lagrangian
  double complementarity = 0.0;  // OcpQp: Σ slack x multiplier over the tracking cost; DenseQp:
                                 // largest slack x multiplier over max(1, |z|)

  /// Component by component the larger one; NaN stays.
  void Worsen(const KktResidual& other) noexcept;
};

/// What a residual may be. False for NaN.
struct KktLimits {
  double primal = 1e-6, dual = 1e-9, stationarity = 1e-9, complementarity = 1e-9;
  [[nodiscard]] bool Hold(const KktResidual& r) const noexcept {
    return r.primal <= primal && r.dual <= dual && r.stationarity <= stationarity &&
           r.complementarity <= complementarity;
  }
};
inline constexpr KktLimits kActiveSetLimits;  // exact up to rounding
inline constexpr KktLimits kInteriorPointLimits{.stationarity = 1e-2, .complementarity = 1e-3};

/// Unknowns and multipliers of an OcpQp. The costate π belongs to the dynamics.
struct OcpPoint {
  std::array<Vec12, kMaxHorizon> u;
  std::array<Vec12, kMaxHorizon + 1> x, pi;
  std::array<LegArray<Vec6>, kMaxHorizon> lambda;  // as in OcpSolution
};

/// Unknowns and multipliers of a dense problem; signs as in DenseSolution, Hz + g + Aᵀy + ... = 0.
struct DensePoint {
  Eigen::VectorXd z, y, of_rows, of_bounds;
};

/// A solution with the multipliers that it lacks: costates by their recursion, πₖ = Qₖxₖ + qₖ +
/// Aₖᵀπₖ₊₁, those of dense equalities in the least-squares sense.
[[nodiscard]] OcpPoint CompletePoint(const OcpQp& qp, const OcpSolution& solution);
[[nodiscard]] DensePoint CompletePoint(const DenseQpView& qp, const DenseSolutionView& solution);

[[nodiscard]] KktResidual CalcKkt(const OcpQp& qp, const OcpPoint& point);
[[nodiscard]] KktResidual CalcKkt(const DenseQpView& qp, const DensePoint& point);

}  // namespace scoria::controller
