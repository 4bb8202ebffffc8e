// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"
#include "core/robot/counters.h"
#include "core/robot/state.h"

namespace scoria::controller {

struct SampleGuardParams {
  double accel_limit_mps2 = 150.0, gyro_limit_radps = 34.0;
  double max_gap_s = 0.1;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("accel_limit_mps2", accel_limit_mps2,
            {.min = 10.0, .max = 1e4, .doc = "from which a sample counts as saturated"});
    a.Field("gyro_limit_radps", gyro_limit_radps, {.min = 1.0, .max = 1e3});
    a.Field("max_gap_s", max_gap_s,
            {.min = 0.001, .max = 10.0, .doc = "longest time that one IMU sample may stand for"});
  }
  bool operator==(const SampleGuardParams&) const = default;
};

/// A sensor frame that the estimators may believe, and what was wrong with the one that came.
struct CheckedFrame {
  SensorFrame z;          // what was not finite keeps its last good value
  double imu_dt_s = 0.0;  // since the last IMU sample; 0: there is no new one
  bool imu_saturated = false;
};

/// Distrusts what comes over the wire: values that are not finite, stamps that go back, repeat or
/// leap, samples at the end of the sensor's range. Each is counted.
class SampleGuard {
 public:
  explicit SampleGuard(const SampleGuardParams& params) noexcept : params_(params) {}

  [[nodiscard]] const CheckedFrame& Check(const SensorFrame& z, Counters& counters) noexcept;

  /// The last frame checked.
  [[nodiscard]] const SensorFrame& last() const noexcept { return checked_.z; }

  void set_params(const SampleGuardParams& params) noexcept { params_ = params; }

 private:
  [[nodiscard]] double TimeSinceLast(const SensorFrame& z, Counters& counters) noexcept;

  SampleGuardParams params_;
  CheckedFrame checked_;
  bool has_stamp_ = false;
  double stamp_s_ = 0.0;
  double period_s_ = 0.0;  // shortest time between two samples so far; 0: not known
};

}  // namespace scoria::controller
