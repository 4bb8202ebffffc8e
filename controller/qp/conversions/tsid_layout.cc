// SPDX-License-Identifier: BSD-3-Clause
#include "controller/qp/conversions/tsid_layout.h"

namespace scoria::controller {

/// Rows of contacts and cones.
void TsidLayout::AddStanceFeet() noexcept {
  for (const Leg leg : kLegs) {
    if (!stance[leg]) continue;
    contact[leg] = equalities;
    equalities += 3;
    cone[leg] = rows;
    rows += cone_rows;
  }
}

TsidLayout TsidLayout::Compact(const TsidProblem& p, TsidVariables variables) noexcept {
  TsidLayout out;
  out.stance = p.stance;
  out.full = variables == TsidVariables::kFull;
  out.torque_rows = !out.full && p.limit_torques;
  if (out.full) out.equalities = kMotion;
  for (const Leg leg : kLegs) {
    if (!p.stance[leg]) continue;
    out.force[leg] = out.variables;
    out.variables += 3;
  }
  out.AddStanceFeet();
  if (!out.full && !out.torque_rows) return out;
  int& end = out.full ? out.variables : out.rows;
  for (const Leg leg : kLegs) {
    out.torque[leg] = end;
    end += kJointsPerLeg;
  }
  return out;
}

TsidLayout TsidLayout::OfFile(const LegArray<bool>& stance, TsidVariables variables,
                              int cone_rows) noexcept {
  TsidLayout out;
  out.stance = stance;
  out.full = variables == TsidVariables::kFull;
  out.idle_forces = true;
  out.torque_rows = !out.full;
  out.cone_rows = cone_rows;
  int& torque = out.full ? out.variables : out.rows;
  for (const Leg leg : kLegs) {
    out.torque[leg] = torque;
    torque += kJointsPerLeg;
  }
  for (const Leg leg : kLegs) {
    out.force[leg] = out.variables;
    out.variables += 3;
  }
  if (out.full) out.equalities = kMotion;
  out.AddStanceFeet();
  return out;
}

}  // namespace scoria::controller
