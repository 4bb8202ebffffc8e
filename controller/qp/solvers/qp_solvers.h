// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "controller/qp/solvers/dense_solver.h"
#include "controller/qp/solvers/ocp_solver.h"
#include "controller/qp/solvers/tsid_solver.h"

namespace scoria::controller {

template <class Solver>
struct NamedSolver {
  std::string name;
  std::unique_ptr<Solver> solver;
};

/// Solvers to compare, by the kind of problem that they take.
struct QpSolvers {
  std::vector<NamedSolver<OcpSolver>> ocp;
  std::vector<NamedSolver<TsidSolver>> tsid;
  std::vector<NamedSolver<DenseSolver>> dense;
};

/// Those of this library. A target with a foreign solver appends its own.
[[nodiscard]] QpSolvers MakeQpSolvers();

}  // namespace scoria::controller
