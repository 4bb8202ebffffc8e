// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "controller/qp/conversions/tsid_layout.h"
#include "controller/qp/problems/kkt.h"

namespace scoria::controller {

/// A problem of the MPC with its solution, as a file keeps it: docs/qp_format.md.
struct OcpRecord {
  static constexpr std::size_t kMeta = 20;
  // Which of the meta numbers say what.
  static constexpr std::size_t kStage = 3, kFriction = 4, kForceMin = 5, kForceMax = 6, kMass = 8,
                               kExactHold = 9, kObjective = 16;
  static constexpr double kWeightPerMass_mps2 = 9.81;  // start_force_N is the mass's weight

  std::array<double, kMeta> meta{};
  OcpQp qp;
  OcpPoint point;
};

/// A whole-body problem in dense form with its solution.
struct DenseRecord {
  static constexpr std::size_t kMeta = 16;
  static constexpr std::size_t kStanceFeet = 2, kStanceMask = 3, kEqualities = 4, kRows = 5;
  static constexpr unsigned kAllFeet = (1u << kNumLegs) - 1;

  std::array<double, kMeta> meta{};
  DenseQp qp;
  DensePoint point;

  /// Where the blocks of the whole-body problem lie. @pre the stance mask is valid.
  [[nodiscard]] TsidLayout layout() const noexcept;
};

[[nodiscard]] OcpRecord MakeRecord(const OcpQp& qp, const OcpSolution& solution);
/// The reduced form. @pre the solution is optimal.
[[nodiscard]] DenseRecord MakeRecord(const TsidRecord& solved);

}  // namespace scoria::controller
