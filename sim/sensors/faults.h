// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/config/archive.h"
#include "core/event_clock.h"
#include "core/robot/legs.h"

namespace scoria::sim {

enum class SensorFaultKind {
  kFootDrift,    // counts, reached after ramp_s
  kFootStuck,    // the counts stay where they are; no magnitude
  kFootDropout,  // 0 counts; no magnitude
  kFootPacked,  // N: soil in the foot presses by this and lets through `gain` of the ground's force
  kImuBiasStep,        // rad/s, on every axis of the gyro
  kImuTemperature,     // K, reached after ramp_s; moves every bias of gyro and accelerometer
  kEncoderOffset,      // rad, on every angle of the leg; the velocity stays right
  kTorqueDropout,      // 0 N m; no magnitude
  kTorqueTemperature,  // N m, reached after ramp_s, on every joint of the leg
  kImuDropout,         // share of samples that never arrive, at random
  kImuNan,             // samples are not a number; no magnitude
  kAccelBiasStep       // m/s^2, on every axis of the accelerometer
};
constexpr std::array<std::pair<SensorFaultKind, std::string_view>, 12> EnumNames(SensorFaultKind) {
  return {{{SensorFaultKind::kFootDrift, "foot_drift"},
           {SensorFaultKind::kFootStuck, "foot_stuck"},
           {SensorFaultKind::kFootDropout, "foot_dropout"},
           {SensorFaultKind::kFootPacked, "foot_packed"},
           {SensorFaultKind::kImuBiasStep, "imu_bias_step"},
           {SensorFaultKind::kImuTemperature, "imu_temperature"},
           {SensorFaultKind::kEncoderOffset, "encoder_offset"},
           {SensorFaultKind::kTorqueDropout, "torque_dropout"},
           {SensorFaultKind::kTorqueTemperature, "torque_temperature"},
           {SensorFaultKind::kImuDropout, "imu_dropout"},
           {SensorFaultKind::kImuNan, "imu_nan"},
           {SensorFaultKind::kAccelBiasStep, "accel_bias_step"}}};
}

/// A sensor that goes wrong. Faults add up where they meet.
struct SensorFault {
  double at_s = 0.0, duration_s = 0.0;
  SensorFaultKind kind = SensorFaultKind::kFootDrift;
  std::vector<std::string> legs;
  double magnitude = 0.0;
  double ramp_s = 30.0;
  double gain = 0.5;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("at_s", at_s, {.min = 0.0, .doc = "since the robot stands"});
    a.Field("duration_s", duration_s,
            {.min = 0.0, .max = 1e6, .doc = "simulated time; 0: to the end"});
    a.Required("kind", kind);
    a.Field("legs", legs, {.doc = "FL, FR, HL, HR; empty: all"});
    a.Field("magnitude", magnitude,
            {.doc = "foot_drift counts, foot_packed N, imu_bias_step rad/s, accel_bias_step m/s^2, "
                    "imu_temperature K, encoder_offset rad, torque_temperature N m, imu_dropout "
                    "share of samples; none for the others"});
    a.Field("ramp_s", ramp_s,
            {.min = 0.001,
             .max = 1e6,
             .doc = "foot_drift, imu_temperature, torque_temperature: time to full magnitude"});
    a.Field("gain", gain,
            {.min = 0.0,
             .max = 10.0,
             .doc = "foot_packed: share of the ground's force that still reaches the sensor"});
  }
  [[nodiscard]] std::string Problem() const;
  bool operator==(const SensorFault&) const = default;
};

/// What faults do to each sensor in one step.
struct ImuFault {
  Vec3 gyro_bias_radps = Vec3::Zero();
  Vec3 accel_bias_mps2 = Vec3::Zero();
  double lost_share = 0.0;
  bool not_a_number = false;
};
struct EncoderFault {
  double offset_rad = 0.0;
};
struct TorqueFault {
  double offset_Nm = 0.0;
  bool is_dead = false;
};
struct FootFault {
  double drift_counts = 0.0;
  double gain = 1.0, load_N = 0.0;
  bool is_stuck = false, is_dead = false;
};
struct FaultEffects {
  ImuFault imu;
  LegArray<EncoderFault> encoders;
  LegArray<TorqueFault> torque;
  LegArray<FootFault> feet;
};

/// Faults in their course.
class FaultSchedule {
 public:
  explicit FaultSchedule(std::vector<SensorFault> faults);

  [[nodiscard]] const FaultEffects& Update(const core::EventClock& now) noexcept;

  [[nodiscard]] const std::vector<SensorFault>& faults() const noexcept { return faults_; }
  /// Whether faults()[i] began in the last Update.
  [[nodiscard]] bool HasBegun(std::size_t i) const noexcept { return states_[i].begins; }

 private:
  struct State {
    LegArray<bool> legs;
    core::EventTimer timer;
    bool begins = false;
  };
  void Apply(const SensorFault& fault, const LegArray<bool>& legs, double since_s) noexcept;
  void ApplyToLeg(const SensorFault& fault, Leg leg, double ramped) noexcept;

  std::vector<SensorFault> faults_;
  std::vector<State> states_;
  FaultEffects effects_;
};

}  // namespace scoria::sim
