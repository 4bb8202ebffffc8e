// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensors/torque_sensor.h"

namespace scoria::sim {
namespace {

Vec3 OfLeg(const Vec12& v, Leg leg) noexcept {
  return v.segment<kJointsPerLeg>(kJointsPerLeg * static_cast<int>(leg));
}

}  // namespace

TorqueSensor::TorqueSensor(const TorqueSensorParams& params, double step_s, std::uint64_t seed)
    : noise_Nm_(params.noise_Nm),
      noise_(seed, 0, core::Stream::kTorqueSensor),
      clock_(SampleClock(params.sampling, step_s)),
      delay_(Latency<LegArray<Vec3>>(params.sampling, step_s)) {
  const Vec12 gain = Vec12::Ones() + params.gain_error * DrawNormals<kNumJoints>(noise_);
  const Vec12 offset = params.offset_Nm * DrawNormals<kNumJoints>(noise_);
  for (const Leg leg : kLegs) {
    gain_[leg] = OfLeg(gain, leg);
    offset_Nm_[leg] = OfLeg(offset, leg);
  }
}

void TorqueSensor::Reset() noexcept {
  clock_.Reset();
  delay_.Clear();
}

const LegArray<Vec3>& TorqueSensor::Read(const LegArray<Vec3>& motor_tau_Nm,
                                         const LegArray<TorqueFault>& faults) noexcept {
  if (clock_.Tick()) {
    const Vec12 noise = noise_Nm_ * DrawNormals<kNumJoints>(noise_);
    for (const Leg leg : kLegs) {
      const Vec3 tau = gain_[leg].cwiseProduct(motor_tau_Nm[leg]) + offset_Nm_[leg] +
                       OfLeg(noise, leg) + Vec3::Constant(faults[leg].offset_Nm);
      newest_Nm_[leg] = faults[leg].is_dead ? Vec3::Zero() : tau;
    }
  }
  return delay_.Pass(newest_Nm_);
}

}  // namespace scoria::sim
