// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/problems/dense_qp.h"

namespace scoria::controller {

/// One way to solve a dense problem.
class DenseSolver {
 public:
  virtual ~DenseSolver() = default;
  /// @returns the solver's own memory, valid until its next Solve; z and multipliers are empty
  ///          where the status is kTooLarge.
  [[nodiscard]] virtual DenseSolutionView Solve(const DenseQpView& qp) noexcept = 0;
};

}  // namespace scoria::controller
