// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/math/delay_line.h"
#include "core/math/types.h"
#include "core/rate.h"
#include "core/rng.h"
#include "sim/sensors/sensor_params.h"

namespace scoria::sim {

/// When a sensor samples: a rate above that of the physics is one sample in every step.
[[nodiscard]] inline core::RateDivider SampleClock(const SamplingParams& params, double step_s) {
  return {std::min(params.rate_Hz, 1.0 / step_s), step_s};
}

/// What is on its way from the sensor to the controller.
template <class T>
[[nodiscard]] core::DelayLine<T> Latency(const SamplingParams& params, double step_s) {
  return core::DelayLine<T>(static_cast<std::size_t>(std::lround(params.latency_s / step_s)));
}

/// Independent standard normals.
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, 1> DrawNormals(core::Rng& rng) noexcept {
  Eigen::Matrix<double, N, 1> x;
  for (double& value : x) value = rng.NextQuickNormal();
  return x;
}

}  // namespace scoria::sim
