// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <numbers>

namespace scoria::core {

/// Time constant of a first-order low pass of this cutoff frequency.
[[nodiscard]] inline double TimeConstant_s(double cutoff_Hz) noexcept {
  return 1.0 / (2.0 * std::numbers::pi * cutoff_Hz);
}

/// How much of the way to an input that is held for dt a first-order low pass goes; the whole way
/// for a time constant of 0.
[[nodiscard]] inline double LowPassShare(double time_constant_s, double dt_s) noexcept {
  return time_constant_s > 0.0 ? -std::expm1(-dt_s / time_constant_s) : 1.0;
}

/// First-order low pass of a number or vector.
template <class T>
void LowPass(T& y, const T& u, double time_constant_s, double dt_s) noexcept {
  y += LowPassShare(time_constant_s, dt_s) * (u - y);
}

}  // namespace scoria::core
