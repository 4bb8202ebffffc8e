// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/robot/state.h"
#include "sim/sensors/faults.h"
#include "sim/sensors/sampling.h"

namespace scoria::sim {

/// Force sensors in the feet as the firmware passes them on: whole counts
///   round(gain max(F − dead band, 0) + zero + drift)   in [0, limit],
/// with a gain and a zero level of each foot and a zero that drifts as a random walk.
class FootForceSensors {
 public:
  /// Draws gains and zero levels of this turn-on.
  FootForceSensors(const FootForceParams& params, double step_s, std::uint64_t seed);

  /// One physics step. @returns the newest sample that has arrived, counts.
  [[nodiscard]] const LegArray<double>& Read(const LegArray<double>& f_normal_N,
                                             const LegArray<FootFault>& faults) noexcept;

  /// The robot was placed: forgets samples on their way; gains, zeros and drift stay.
  void Reset() noexcept;

 private:
  [[nodiscard]] double Counts(Leg leg, double force_N, const FootFault& fault) const noexcept;

  FootForceParams params_;
  core::Rng noise_;
  core::RateDivider clock_;
  core::DelayLine<LegArray<double>> delay_;
  double walk_sigma_;
  LegArray<double> gain_per_N_, zero_;
  LegArray<double> newest_;
  bool has_sampled_ = false;
};

}  // namespace scoria::sim
