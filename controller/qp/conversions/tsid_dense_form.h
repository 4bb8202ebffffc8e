// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/conversions/tsid_layout.h"
#include "controller/qp/problems/dense_qp.h"

namespace scoria::controller {

/// Writes a whole-body problem as a dense one into `out`, all of it; in place, because the control
/// loop has no time to copy it. The force of a foot in the air that the layout keeps costs little
/// and ends at zero.
/// @pre  layout.stance is that of the problem, and cones have kConeRows rows.
void ToDense(const TsidProblem& problem, const TsidLayout& layout, DenseQp& out) noexcept;

/// The blocks of a dense problem. The reduced form holds no bias of the legs: h_l is zero, and the
/// limits are those on τ − h. A cone of fewer rows is filled up with 0 ≥ −1.
/// @pre  the sizes are those of the layout; of the two sides of a cone's row one is unbounded.
[[nodiscard]] TsidProblem FromDense(const DenseQp& qp, const TsidLayout& layout) noexcept;

/// Solutions with their multipliers, from one form to the other; the same preconditions.
[[nodiscard]] TsidSolution FromDense(const DenseSolutionView& solution, const TsidProblem& problem,
                                     const TsidLayout& layout) noexcept;
[[nodiscard]] DenseSolution ToDense(const TsidSolution& solution,
                                    const TsidLayout& layout) noexcept;

}  // namespace scoria::controller
