// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensors/foot_force.h"

#include <algorithm>
#include <cmath>

namespace scoria::sim {

FootForceSensors::FootForceSensors(const FootForceParams& params, double step_s, std::uint64_t seed)
    : params_(params),
      noise_(seed, 0, core::Stream::kFootForce),
      clock_(SampleClock(params.sampling, step_s)),
      delay_(Latency<LegArray<double>>(params.sampling, step_s)),
      walk_sigma_(params.drift_per_sqrt_s * std::sqrt(clock_.interval_s())) {
  for (const Leg leg : kLegs) {
    // The logarithm keeps gains positive at any spread.
    gain_per_N_[leg] = params.gain_per_N * std::exp(params.gain_spread * noise_.NextNormal());
    zero_[leg] = noise_.NextUniform(params.zero_min, params.zero_max);
  }
}

void FootForceSensors::Reset() noexcept {
  clock_.Reset();
  delay_.Clear();
}

double FootForceSensors::Counts(Leg leg, double force_N, const FootFault& fault) const noexcept {
  if (fault.is_dead) return 0.0;
  const double sensed_N = fault.gain * force_N + fault.load_N;
  const double counts = gain_per_N_[leg] * std::max(sensed_N - params_.dead_band_N, 0.0) +
                        zero_[leg] + fault.drift_counts;
  const double step = params_.resolution;
  return std::clamp(step > 0.0 ? step * std::round(counts / step) : counts, 0.0, params_.limit);
}

const LegArray<double>& FootForceSensors::Read(const LegArray<double>& f_normal_N,
                                               const LegArray<FootFault>& faults) noexcept {
  if (clock_.Tick()) {
    const Eigen::Vector4d walk = walk_sigma_ * DrawNormals<kNumLegs>(noise_);
    for (const Leg leg : kLegs) {
      zero_[leg] += walk[static_cast<int>(leg)];
      const bool keeps = faults[leg].is_stuck && has_sampled_;
      if (!keeps) newest_[leg] = Counts(leg, f_normal_N[leg], faults[leg]);
    }
    has_sampled_ = true;
  }
  return delay_.Pass(newest_);
}

}  // namespace scoria::sim
