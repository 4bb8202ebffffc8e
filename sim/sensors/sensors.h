// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "core/robot/description.h"
#include "core/robot/state.h"
#include "sim/plant/truth.h"
#include "sim/sensors/encoders.h"
#include "sim/sensors/faults.h"
#include "sim/sensors/foot_force.h"
#include "sim/sensors/imu.h"
#include "sim/sensors/sensor_params.h"
#include "sim/sensors/torque_sensor.h"

namespace scoria::sim {

/// All sensors of a robot from turn-on to the end of an episode, with their faults. Each has a
/// random stream of its own, so none shifts another's numbers.
class Sensors {
 public:
  /// `robot` is borrowed and must outlive the sensors.
  Sensors(const core::RobotDescription& robot, const SensorParams& params,
          std::vector<SensorFault> faults, const Vec3& gravity_W, double step_s,
          std::uint64_t seed);

  /// What has arrived by the physics step `step`; to be called in every one.
  /// @param now         on which faults are scheduled.
  /// @param give_truth  fills SensorFrame::truth; only for controllers that run on the `truth`
  ///                       estimator.
  /// Errors: none; noexcept, no allocation.
  [[nodiscard]] SensorFrame Read(const Truth& truth, const LegArray<Vec3>& motor_tau_Nm,
                                 std::int64_t step, const core::EventClock& now,
                                 bool give_truth) noexcept;

  /// After the robot was placed somewhere: forgets its velocity, samples on their way and tracking.
  /// Biases, gains and faults stay.
  void Reset() noexcept;

  [[nodiscard]] const std::vector<SensorFault>& faults() const noexcept { return faults_.faults(); }
  /// Whether faults()[i] began in the last Read.
  [[nodiscard]] bool HasBegun(std::size_t i) const noexcept { return faults_.HasBegun(i); }

 private:
  bool has_foot_sensors_;
  FaultSchedule faults_;
  Imu imu_;
  Encoders encoders_;
  TorqueSensor torque_;
  FootForceSensors foot_force_;
};

}  // namespace scoria::sim
