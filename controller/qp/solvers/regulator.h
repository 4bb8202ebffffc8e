// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/problems/ocp_qp.h"

namespace scoria::controller {

/// The stance feet of a whole horizon, stage after stage.
struct FootIndex {
  static constexpr int kMaxFeet = kMaxHorizon * kNumLegs;
  int count = 0;
  std::array<int, kMaxHorizon + 1> first{};  // feet of stage k are first[k] to first[k + 1]
  std::array<int, kMaxFeet> stage{};
  std::array<Leg, kMaxFeet> leg{};

  /// Errors: none.
  [[nodiscard]] static FootIndex Of(const OcpQp& qp) noexcept;
};

/// One quantity with `columns` components for every stance foot. Feet lie side by side in memory,
/// so that a loop over them vectorises.
template <int columns>
using FootTable = Eigen::Array<double, FootIndex::kMaxFeet, columns>;

/// Hessian of the forces of every foot: [a 0 d; 0 b e; d e c], and the last pivot of its LDLᵀ
/// factorisation, c − d²/a − e²/b, which the caller can give without cancellation.
struct FootHessian {
  FootTable<1> a, b, c, d, e, pivot;
};

/// Trajectory of states, and forces of all feet.
struct FootTrajectory {
  FootTable<3> u;
  std::array<Vec12, kMaxHorizon + 1> x;
};

/// The equality-constrained problem inside every iteration of an interior point method:
///   min Σ ½ xᵀQx + qᵀx + Σ ½ uᵀHu + gᵀu  s.t. the dynamics of OcpQp,
/// with one 3x3 block of H per stance foot. Factorised once, solved for several g.
class Regulator {
 public:
  virtual ~Regulator() = default;
  virtual void Load(const OcpQp& qp, const FootIndex& feet) noexcept = 0;
  virtual void Factorize(const OcpQp& qp, const FootIndex& feet,
                         const FootHessian& hessian) noexcept = 0;
  /// Not finite if the problem is not convex or its data are broken.
  virtual void Solve(const OcpQp& qp, const FootIndex& feet, const FootTable<3>& gradient,
                     FootTrajectory& out) noexcept = 0;
};

}  // namespace scoria::controller
