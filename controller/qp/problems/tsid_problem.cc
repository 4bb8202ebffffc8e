// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/problems/tsid_problem.h"

namespace scoria::controller {

LegArray<Vec3> CalcTorques(const TsidProblem& p, const TsidSolution& s) noexcept {
  LegArray<Vec3> tau;
  for (const Leg leg : kLegs) {
    tau[leg] = p.H_Bl[leg].transpose() * s.a + p.H_ll[leg] * s.qdd[leg] + p.h_l[leg];
    if (p.stance[leg]) tau[leg] -= p.J[leg].transpose() * s.f[leg];
  }
  return tau;
}

}  // namespace scoria::controller
