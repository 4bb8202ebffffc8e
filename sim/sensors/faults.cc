// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sensors/faults.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace scoria::sim {
namespace {

/// Offset of a MEMS unit over temperature: 0.015 deg/s and 0.2 mg per K, the order that data sheets
/// of the better consumer units give.
constexpr double kGyroPerKelvin_radps = 2.6e-4, kAccelPerKelvin_mps2 = 2e-3;

bool ConcernsLegs(SensorFaultKind kind) {
  switch (kind) {
    case SensorFaultKind::kImuBiasStep:
    case SensorFaultKind::kImuTemperature:
    case SensorFaultKind::kImuDropout:
    case SensorFaultKind::kImuNan:
    case SensorFaultKind::kAccelBiasStep:
      return false;
    default:
      return true;
  }
}

/// Packed soil may only take force, without pressing.
bool MayLackMagnitude(SensorFaultKind kind) { return kind == SensorFaultKind::kFootPacked; }

bool HasMagnitude(SensorFaultKind kind) {
  switch (kind) {
    case SensorFaultKind::kFootStuck:
    case SensorFaultKind::kFootDropout:
    case SensorFaultKind::kTorqueDropout:
    case SensorFaultKind::kImuNan:
      return false;
    default:
      return true;
  }
}

LegArray<bool> LegsOf(const SensorFault& fault) {
  LegArray<bool> legs(fault.legs.empty());
  for (const Leg leg : kLegs) {
    const auto named = std::find(fault.legs.begin(), fault.legs.end(), LegName(leg));
    if (named != fault.legs.end()) legs[leg] = true;
  }
  return legs;
}

}  // namespace

std::string SensorFault::Problem() const {
  const std::string_view name = core::EnumName(kind);
  for (const std::string& leg : legs) {
    const auto known = [&](Leg l) { return LegName(l) == leg; };
    if (std::none_of(kLegs.begin(), kLegs.end(), known))
      return fmt::format("legs: unknown \"{}\"; choices: FL, FR, HL, HR", leg);
  }
  if (!legs.empty() && !ConcernsLegs(kind)) return fmt::format("legs: {} concerns no leg", name);
  if (HasMagnitude(kind) != (magnitude != 0.0) && !MayLackMagnitude(kind))
    return fmt::format("magnitude: {} {}", name, HasMagnitude(kind) ? "needs one" : "has none");
  const bool is_share = magnitude > 0.0 && magnitude <= 1.0;
  if (kind == SensorFaultKind::kImuDropout && !is_share)
    return "magnitude: imu_dropout needs a share in (0, 1]";
  return "";
}

FaultSchedule::FaultSchedule(std::vector<SensorFault> faults) : faults_(std::move(faults)) {
  for (const SensorFault& fault : faults_) states_.push_back({LegsOf(fault), {}});
}

const FaultEffects& FaultSchedule::Update(const core::EventClock& now) noexcept {
  if (faults_.empty()) return effects_;
  effects_ = {};
  for (std::size_t i = 0; i < faults_.size(); ++i) {
    const SensorFault& fault = faults_[i];
    State& state = states_[i];
    state.begins = state.timer.BeginAfter(fault.at_s, now);
    const std::optional<double>& begun_s = state.timer.begun_s();
    const bool to_the_end = fault.duration_s == 0.0;
    if (begun_s && (to_the_end || state.timer.Runs(fault.duration_s, now)))
      Apply(fault, state.legs, now.time_s - *begun_s);
  }
  return effects_;
}

void FaultSchedule::Apply(const SensorFault& fault, const LegArray<bool>& legs,
                          double since_s) noexcept {
  const double ramped = fault.magnitude * std::min(1.0, since_s / fault.ramp_s);
  ImuFault& imu = effects_.imu;
  switch (fault.kind) {
    case SensorFaultKind::kImuBiasStep:
      imu.gyro_bias_radps += Vec3::Constant(fault.magnitude);
      return;
    case SensorFaultKind::kAccelBiasStep:
      imu.accel_bias_mps2 += Vec3::Constant(fault.magnitude);
      return;
    case SensorFaultKind::kImuTemperature:
      imu.gyro_bias_radps += Vec3::Constant(kGyroPerKelvin_radps * ramped);
      imu.accel_bias_mps2 += Vec3::Constant(kAccelPerKelvin_mps2 * ramped);
      return;
    case SensorFaultKind::kImuDropout:
      imu.lost_share = 1.0 - (1.0 - imu.lost_share) * (1.0 - fault.magnitude);
      return;
    case SensorFaultKind::kImuNan:
      imu.not_a_number = true;
      return;
    default:
      for (const Leg leg : kLegs) {
        if (legs[leg]) ApplyToLeg(fault, leg, ramped);
      }
  }
}

void FaultSchedule::ApplyToLeg(const SensorFault& fault, Leg leg, double ramped) noexcept {
  FootFault& foot = effects_.feet[leg];
  switch (fault.kind) {
    case SensorFaultKind::kFootDrift:
      foot.drift_counts += ramped;
      return;
    case SensorFaultKind::kFootStuck:
      foot.is_stuck = true;
      return;
    case SensorFaultKind::kFootDropout:
      foot.is_dead = true;
      return;
    case SensorFaultKind::kFootPacked:
      foot.gain *= fault.gain;
      foot.load_N += fault.magnitude;
      return;
    case SensorFaultKind::kEncoderOffset:
      effects_.encoders[leg].offset_rad += fault.magnitude;
      return;
    case SensorFaultKind::kTorqueDropout:
      effects_.torque[leg].is_dead = true;
      return;
    case SensorFaultKind::kTorqueTemperature:
      effects_.torque[leg].offset_Nm += ramped;
      return;
    default:
      return;
  }
}

}  // namespace scoria::sim
