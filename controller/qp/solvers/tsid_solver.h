// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/problems/tsid_problem.h"

namespace scoria::controller {

/// One way to solve a TsidProblem.
class TsidSolver {
 public:
  virtual ~TsidSolver() = default;
  [[nodiscard]] virtual TsidSolution Solve(const TsidProblem& problem) noexcept = 0;
};

}  // namespace scoria::controller
