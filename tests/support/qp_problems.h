// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/problems/ocp_qp.h"
#include "controller/qp/problems/tsid_problem.h"
#include "core/rng.h"

namespace scoria::test {

/// A small trot-like problem of six stages. @param euler  forces do not move positions at once.
[[nodiscard]] controller::OcpQp SampleOcp(core::Rng& rng, bool euler);

/// A whole-body problem with random dynamics, feasible by construction, some torque limits close to
/// a feasible point.
[[nodiscard]] controller::TsidProblem SampleTsid(core::Rng& rng, const LegArray<bool>& stance);

/// Three feet on the ground at most, and four, in turns.
[[nodiscard]] LegArray<bool> SampleStance(int trial);

}  // namespace scoria::test
