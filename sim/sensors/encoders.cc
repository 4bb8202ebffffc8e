// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensors/encoders.h"

#include <cmath>
#include <numbers>

namespace scoria::sim {

// The deviation e = (θ̂ − θ, ω̂ − θ') from a ramp obeys e' = A e with the double eigenvalue −ω_n, so
// exp(A T) = e^(−ω_n T) (I + (A + ω_n I) T).
TrackingLoop::TrackingLoop(double bandwidth_Hz, double step_s) noexcept : step_s_(step_s) {
  const double w = 2.0 * std::numbers::pi * bandwidth_Hz, wT = w * step_s;
  decay_ << 1.0 - wT, step_s, -w * wT, 1.0 + wT;
  decay_ *= std::exp(-wT);
}

TrackingLoop::State TrackingLoop::Advance(const State& s, double input_rad) const noexcept {
  const double ramp = (input_rad - s.input_rad) / step_s_;
  const Vec2 deviation(s.angle_rad - s.input_rad, s.velocity_radps - ramp);
  const Vec2 left = decay_ * deviation;
  const double velocity = ramp + left[1];
  constexpr double kStill_radps = 1e-12;  // a joint at rest would decay into slow denormal numbers
  return {input_rad, input_rad + left[0], std::abs(velocity) < kStill_radps ? 0.0 : velocity};
}

Encoders::Encoders(const EncoderParams& params, double step_s, std::uint64_t seed)
    : quantum_rad_(params.bits == 0 ? 0.0 : std::ldexp(2.0 * std::numbers::pi, -params.bits)),
      tracks_(params.velocity_bandwidth_Hz > 0.0),
      clock_(SampleClock(params.sampling, step_s)),
      delay_(Latency<Sample>(params.sampling, step_s)),
      loop_(params.velocity_bandwidth_Hz, step_s) {
  core::Rng rng(seed, 0, core::Stream::kEncoder);
  for (Vec3& leg : phase_rad_) {
    for (double& phase : leg) phase = quantum_rad_ * rng.NextUniform(-0.5, 0.5);
  }
}

void Encoders::Reset() noexcept {
  clock_.Reset();
  delay_.Clear();
  is_tracking_ = false;
}

double Encoders::Quantise(double q_rad, double phase_rad) const noexcept {
  if (quantum_rad_ == 0.0) return q_rad;
  return quantum_rad_ * std::nearbyint((q_rad + phase_rad) / quantum_rad_) - phase_rad;
}

const Encoders::Sample& Encoders::Read(const RobotState& state,
                                       const LegArray<EncoderFault>& faults) noexcept {
  const bool samples = clock_.Tick();
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const double q = Quantise(state.q[leg][j], phase_rad_[leg][j]);
      TrackingLoop::State& tracked = tracked_[leg][static_cast<std::size_t>(j)];
      tracked = is_tracking_ ? loop_.Advance(tracked, q) : TrackingLoop::State{q, q, 0.0};
      if (!samples) continue;
      newest_.q[leg][j] = q + faults[leg].offset_rad;
      newest_.qd[leg][j] = tracks_ ? tracked.velocity_radps : state.qd[leg][j];
    }
  }
  is_tracking_ = true;
  return delay_.Pass(newest_);
}

}  // namespace scoria::sim
