// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/sample_guard.h"

#include <algorithm>
#include <cmath>

namespace scoria::controller {
namespace {

/// Takes over what is finite. @returns false if something is not.
bool Take(const LegArray<Vec3>& from, LegArray<Vec3>& to) noexcept {
  bool good = true;
  for (const Leg leg : kLegs) {
    if (from[leg].allFinite()) {
      to[leg] = from[leg];
    } else {
      good = false;
    }
  }
  return good;
}

}  // namespace

/// Zero unless there is a newer sample.
double SampleGuard::TimeSinceLast(const SensorFrame& z, Counters& counters) noexcept {
  if (!has_stamp_) {
    has_stamp_ = true;
    stamp_s_ = z.imu_time_s;
    return 0.0;
  }
  const double dt_s = z.imu_time_s - stamp_s_;
  constexpr double kSameStamp_s = 1e-9;
  if (dt_s < -kSameStamp_s) {
    counters.Add(Count::kImuBackwards);
    stamp_s_ = z.imu_time_s;  // the clock was set: go on from there
    return 0.0;
  }
  if (dt_s <= kSameStamp_s) {
    counters.Add(Count::kImuRepeated);
    return 0.0;
  }
  constexpr double kLate = 1.5;  // periods
  if (period_s_ > 0.0 && dt_s > kLate * period_s_) counters.Add(Count::kImuGap);
  period_s_ = period_s_ > 0.0 ? std::min(period_s_, dt_s) : dt_s;
  stamp_s_ = z.imu_time_s;
  return std::min(dt_s, params_.max_gap_s);
}

const CheckedFrame& SampleGuard::Check(const SensorFrame& z, Counters& counters) noexcept {
  SensorFrame& good = checked_.z;
  good.step = z.step;
  good.truth = z.truth;
  checked_.imu_dt_s = 0.0;
  if (std::isfinite(z.imu_time_s) && z.a_WS_S.allFinite() && z.w_WS_S.allFinite()) {
    checked_.imu_dt_s = TimeSinceLast(z, counters);
    good.a_WS_S = z.a_WS_S;
    good.w_WS_S = z.w_WS_S;
  } else {
    counters.Add(Count::kImuInvalid);  // the next good sample covers its time
  }
  good.imu_time_s = stamp_s_;
  checked_.imu_saturated = good.a_WS_S.cwiseAbs().maxCoeff() > params_.accel_limit_mps2 ||
                           good.w_WS_S.cwiseAbs().maxCoeff() > params_.gyro_limit_radps;
  if (checked_.imu_saturated) counters.Add(Count::kImuSaturated);
  const bool joints_good = Take(z.q, good.q) & Take(z.qd, good.qd) & Take(z.tau_Nm, good.tau_Nm);
  if (!joints_good) counters.Add(Count::kJointInvalid);
  good.foot_force_raw = z.foot_force_raw;  // their health is judged by the contact estimator
  return checked_;
}

}  // namespace scoria::controller
