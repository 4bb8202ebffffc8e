// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>

#include "core/robot/legs.h"

namespace scoria {

/// Who says whether a foot is on the ground.
enum class ContactSource { kTruth, kGaitPhase, kSensor, kObserver };
constexpr std::array<std::pair<ContactSource, std::string_view>, 4> EnumNames(ContactSource) {
  return {{{ContactSource::kTruth, "truth"},
           {ContactSource::kGaitPhase, "gait_phase"},
           {ContactSource::kSensor, "sensor"},
           {ContactSource::kObserver, "momentum_observer"}}};
}

/// Which feet are on the ground, and what each source says of them.
struct ContactEstimate {
  LegArray<bool> contact;                 // fused
  LegArray<ContactSource> source;         // whose it is
  LegArray<Vec3> f_F_W = ZeroPerLeg();    // N, ground on foot, from the momentum observer
  LegArray<bool> sensor, observer;        // their own words
  LegArray<double> sensor_counts;         // over the sensor's threshold
  LegArray<double> observer_probability;  // of contact
  LegArray<bool> sensor_healthy;
  /// Of the trunk, in W without gravity: what the observer takes from the IMU.
  Vec3 vd_WB = Vec3::Zero(), wd_WB = Vec3::Zero();  // m/s^2, rad/s^2
  bool operator==(const ContactEstimate&) const = default;
};

}  // namespace scoria
