// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/math/types.h"
#include "core/rng.h"
#include "sim/sensors/sensor_params.h"

namespace scoria::sim {

/// Tells in which physics steps a sensor samples: in the first, then every so many.
class SampleClock {
 public:
  SampleClock(const SamplingParams& params, double step_s) noexcept
      : every_(std::max(1, static_cast<int>(std::lround(1.0 / (params.rate_Hz * step_s))))),
        interval_s_(every_ * step_s) {}

  /// One physics step. @returns whether the sensor samples in it.
  [[nodiscard]] bool Tick() noexcept {
    const bool due = wait_ == 0;
    wait_ = (due ? every_ : wait_) - 1;
    return due;
  }
  /// Between samples; the rate asked for, to whole steps.
  [[nodiscard]] double interval_s() const noexcept { return interval_s_; }
  void Reset() noexcept { wait_ = 0; }

 private:
  int every_;
  double interval_s_;
  int wait_ = 0;  // steps until the next sample
};

/// Gives back what went in `latency` ago, and the first value until then. Allocates only when
/// built.
template <class T>
class DelayLine {
 public:
  DelayLine(const SamplingParams& params, double step_s)
      : ring_(static_cast<std::size_t>(std::lround(params.latency_s / step_s)) + 1) {}

  /// One physics step.
  [[nodiscard]] const T& Pass(const T& newest) noexcept {
    ring_[next_] = newest;
    const std::size_t oldest = next_ + 1 == ring_.size() ? 0 : next_ + 1;
    const T& due = ring_[filled_ + 1 < ring_.size() ? 0 : oldest];
    filled_ = std::min(filled_ + 1, ring_.size());
    next_ = oldest;
    return due;
  }
  void Reset() noexcept { next_ = filled_ = 0; }

 private:
  std::vector<T> ring_;
  std::size_t next_ = 0, filled_ = 0;
};

/// Independent standard normals.
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, 1> DrawNormals(core::Rng& rng) noexcept {
  Eigen::Matrix<double, N, 1> x;
  for (double& value : x) value = rng.NextQuickNormal();
  return x;
}

}  // namespace scoria::sim
