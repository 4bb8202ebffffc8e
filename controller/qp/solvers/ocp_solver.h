// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/problems/ocp_qp.h"

namespace scoria::controller {

/// One way to solve an optimal control problem.
class OcpSolver {
 public:
  virtual ~OcpSolver() = default;
  /// May start from its last solution. @returns the solver's own memory, valid until its next
  /// Solve.
  [[nodiscard]] virtual const OcpSolution& Solve(const OcpQp& qp) noexcept = 0;
  /// Forgets the last solution.
  virtual void Reset() noexcept = 0;
};

}  // namespace scoria::controller
