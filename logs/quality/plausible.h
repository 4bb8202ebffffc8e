// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "logs/mapping/signals.h"

namespace scoria::logs {

/// Above it no value of a signal is a measurement in any unit that it may be in by mistake
/// (degrees, millimetres, counts), but a word of its own, as 2.146e9 or 16000 of Unitree's motors.
[[nodiscard]] constexpr double LargestPlausible(SignalId signal) noexcept {
  switch (signal) {
    case SignalId::kEstimatePosition:
    case SignalId::kTruthPosition:
      return 1e8;  // a hundred kilometres in millimetres
    case SignalId::kFootForce:
    case SignalId::kEstimateVelocity:
    case SignalId::kTruthVelocity:
      return 1e6;
    default:
      return 1e4;  // ten turns a second in degrees
  }
}

[[nodiscard]] inline bool IsPlausible(SignalId signal, double value) noexcept {
  return std::isfinite(value) && std::abs(value) <= LargestPlausible(signal);
}

}  // namespace scoria::logs
