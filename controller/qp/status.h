// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace scoria::controller {

enum class SolveStatus { kOptimal, kIterationLimit, kInfeasible, kNumerical };

[[nodiscard]] constexpr bool IsUsable(SolveStatus status) noexcept {
  return status == SolveStatus::kOptimal || status == SolveStatus::kIterationLimit;
}

}  // namespace scoria::controller
