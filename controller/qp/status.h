// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace scoria::controller {

/// How a solve ended. kTooLarge: the problem exceeds the solver's memory, nothing was tried.
enum class SolveStatus { kOptimal, kIterationLimit, kInfeasible, kNumerical, kTooLarge };

[[nodiscard]] constexpr bool IsUsable(SolveStatus status) noexcept {
  return status == SolveStatus::kOptimal || status == SolveStatus::kIterationLimit;
}

}  // namespace scoria::controller
