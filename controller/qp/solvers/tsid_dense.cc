// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/tsid_dense.h"

#include "controller/qp/conversions/tsid_dense_form.h"

namespace scoria::controller {

TsidSolution TsidDense::Solve(const TsidProblem& problem) noexcept {
  const TsidLayout layout = TsidLayout::Compact(problem, variables_);
  ToDense(problem, layout, qp_);
  return FromDense(solver_.Solve(qp_), problem, layout);
}

}  // namespace scoria::controller
