// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/solvers/qp_solvers.h"

#include "controller/qp/solvers/dense_active_set.h"
#include "controller/qp/solvers/riccati_ipm.h"
#include "controller/qp/solvers/tsid_nullspace.h"

namespace scoria::controller {

QpSolvers MakeQpSolvers() {
  RiccatiIpmParams params;
  params.tolerance = 1e-6;
  params.max_iterations = 60;
  QpSolvers out;
  out.ocp.push_back({"Riccati", std::make_unique<RiccatiIpm>(params)});
  out.tsid.push_back({"null space", std::make_unique<TsidNullspace>()});
  out.dense.push_back({"dense", std::make_unique<DenseActiveSet>()});
  return out;
}

}  // namespace scoria::controller
