// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/problems/tsid_problem.h"

namespace scoria::controller {

/// The unknowns of a whole-body problem in dense form: accelerations and forces, or torques too.
enum class TsidVariables { kReduced, kFull };

/// Where the blocks of a TsidProblem lie in a dense problem. z begins with a and q̈; A with the
/// trunk's equations of motion, then, in the full form, the legs'; contacts follow. Cones are rows
/// of C. Torque limits are bounds in the full form, rows of C on τ − h in the reduced one.
struct TsidLayout {
  static constexpr int kTrunk = 6, kMotion = kTrunk + kNumJoints;

  LegArray<bool> stance;
  bool full = false;         // τ are variables
  bool idle_forces = false;  // z also holds the forces of feet in the air
  bool torque_rows = false;  // C limits torques
  int cone_rows = TsidProblem::kConeRows;
  int variables = kMotion, equalities = kTrunk, rows = 0;
  LegArray<int> force{0};    // first column of the leg's force, if it has one
  LegArray<int> torque{0};   // first column of its torques, or first row of C
  LegArray<int> contact{0};  // stance feet: first row of A
  LegArray<int> cone{0};     // stance feet: first row of C

  [[nodiscard]] static int joints(Leg leg) noexcept {
    return kTrunk + kJointsPerLeg * static_cast<int>(leg);
  }

  /// The smallest form: z = (a, q̈, f of stance feet, τ), rows of C = (cones, torques).
  [[nodiscard]] static TsidLayout Compact(const TsidProblem& problem,
                                          TsidVariables variables) noexcept;
  /// The form of docs/qp_format.md: z = (a, q̈, τ, f of all feet), rows of C = (torques, cones).
  /// @param cone_rows  1 to TsidProblem::kConeRows.
  [[nodiscard]] static TsidLayout OfFile(const LegArray<bool>& stance, TsidVariables variables,
                                         int cone_rows = TsidProblem::kConeRows) noexcept;

 private:
  void AddStanceFeet() noexcept;
};

}  // namespace scoria::controller
