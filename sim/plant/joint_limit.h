// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace scoria::sim {

/// The least velocity away from a limit that a joint must have at the end of a step, rad/s. A joint
/// near the limit may use up the room that is left; one beyond it is drawn back slowly. None for a
/// joint that the limit does not concern in this step.
/// @param room_rad  to the limit, negative beyond it.
[[nodiscard]] inline std::optional<double> CalcLeastRetreat(double room_rad, double qd_radps,
                                                            double dt_s) noexcept {
  constexpr double kNear_rad = 0.05, kReturn_radps = 1.0;
  if (room_rad > kNear_rad + std::abs(qd_radps) * dt_s) return std::nullopt;
  return -std::max(room_rad / dt_s, -kReturn_radps);
}

}  // namespace scoria::sim
