// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/sets/qp_record.h"

#include <algorithm>
#include <bit>

#include "controller/qp/conversions/tsid_dense_form.h"

namespace scoria::controller {

TsidLayout DenseRecord::layout() const noexcept {
  const bool full = qp.H.rows() > TsidLayout::kMotion + kNumJoints;
  const auto mask = static_cast<unsigned>(meta[kStanceMask]);
  LegArray<bool> stance(false);
  for (const Leg leg : kLegs) stance[leg] = (mask >> static_cast<unsigned>(leg)) % 2 == 1;
  const int cones = static_cast<int>(qp.C.rows()) - (full ? 0 : kNumJoints);
  return TsidLayout::OfFile(stance, full ? TsidVariables::kFull : TsidVariables::kReduced,
                            cones / std::max(1, std::popcount(mask)));
}

OcpRecord MakeRecord(const OcpQp& qp, const OcpSolution& solution) {
  OcpRecord out{{}, qp, CompletePoint(qp, solution)};
  out.meta[OcpRecord::kStage] = qp.stages[0].dt_s;
  out.meta[OcpRecord::kFriction] = qp.friction;
  out.meta[OcpRecord::kForceMin] = qp.f_min_N;
  out.meta[OcpRecord::kForceMax] = qp.f_max_N;
  out.meta[OcpRecord::kMass] = qp.start_force_N / OcpRecord::kWeightPerMass_mps2;
  out.meta[OcpRecord::kExactHold] = qp.forward_euler ? 0.0 : 1.0;
  out.meta[OcpRecord::kObjective] = CalcObjective(qp, solution.u);
  return out;
}

DenseRecord MakeRecord(const TsidRecord& solved) {
  const TsidProblem& p = solved.problem;
  const TsidLayout layout = TsidLayout::OfFile(p.stance, TsidVariables::kReduced);
  DenseRecord out;
  ToDense(p, layout, out.qp);
  out.point = CompletePoint(out.qp, ToDense(solved.solution, layout));
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    out.meta[DenseRecord::kStanceFeet] += 1.0;
    out.meta[DenseRecord::kStanceMask] += 1 << static_cast<int>(leg);
  }
  out.meta[DenseRecord::kEqualities] = layout.equalities;
  out.meta[DenseRecord::kRows] = layout.rows;
  return out;
}

}  // namespace scoria::controller
