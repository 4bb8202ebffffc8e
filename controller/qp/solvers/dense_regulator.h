// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/solvers/regulator.h"

namespace scoria::controller {

/// Regulator for any B, such as an exact zero-order hold, by the textbook Riccati recursion over
/// all twelve forces of a stage; those of feet in the air are decoupled.
class DenseRegulator final : public Regulator {
 public:
  void Load(const OcpQp&, const FootIndex&) noexcept override {}
  void Factorize(const OcpQp& qp, const FootIndex& feet,
                 const FootHessian& hessian) noexcept override;
  void Solve(const OcpQp& qp, const FootIndex& feet, const FootTable<3>& gradient,
             FootTrajectory& out) noexcept override;

 private:
  struct Stage {
    Mat12 B;                                           // columns of feet in the air are zero
    Mat12 L;                                           // Cholesky factor of the input Hessian
    Eigen::Matrix<double, 12, 12, Eigen::RowMajor> Y;  // L⁻¹ BᵀPA
    Vec12 Pb, h;
  };
  std::array<Stage, kMaxHorizon> stages_;
};

}  // namespace scoria::controller
