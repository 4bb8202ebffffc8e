// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace scoria {

/// What did not go to plan. Ticks unless said otherwise.
enum class Count {
  kEarlyContact,       // feet
  kLateContact,        // feet
  kLostContact,        // feet
  kStumble,            // feet
  kMpcFailure,         // solves that failed or were not finite
  kMpcLate,            // solves that came a tick late
  kPlanExpired,        // WBC ticks on a stand-in plan because the last good one was too old
  kWbcFailure,         // solves that failed or were not finite
  kWbcLate,            // solves that did not come in time: the last command stayed
  kTorqueRowsDropped,  // solves that were infeasible with torque limits
  kSingularLeg,        // solves with a stretched stance leg, by the dense form
  kInverseDynamics,    // WBC ticks answered by inverse dynamics instead
  kDamping,            // WBC ticks answered by joint damping
  kJointLimit,         // joints turned back at their limit
  kTiltStop,           // stops because the trunk tilted too far
  kImuInvalid,         // ticks with an IMU sample or stamp that is not finite
  kImuBackwards,       // ticks at which the IMU's clock went back
  kImuRepeated,        // ticks without a new IMU sample
  kImuGap,             // IMU samples that came after a longer time than usual
  kImuSaturated,       // ticks with an IMU sample at the end of its range
  kJointInvalid,       // ticks with a joint reading that is not finite
  kSlip,               // standing feet that the estimator saw slip
  kEstimateRefused,    // corrections of the estimate that were not usable
  kFallbackMpc,        // times that the fallback was engaged, in the order of Monitor
  kFallbackBody,
  kFallbackEstimator,
  kFallbackContact,
  kFallbackFooting,
  kFallbackLoad,
};
constexpr std::array<std::pair<Count, std::string_view>, 29> EnumNames(Count) {
  return {{{Count::kEarlyContact, "early_contact"},
           {Count::kLateContact, "late_contact"},
           {Count::kLostContact, "lost_contact"},
           {Count::kStumble, "stumble"},
           {Count::kMpcFailure, "mpc_failure"},
           {Count::kMpcLate, "mpc_late"},
           {Count::kPlanExpired, "plan_expired"},
           {Count::kWbcFailure, "wbc_failure"},
           {Count::kWbcLate, "wbc_late"},
           {Count::kTorqueRowsDropped, "torque_rows_dropped"},
           {Count::kSingularLeg, "singular_leg"},
           {Count::kInverseDynamics, "inverse_dynamics"},
           {Count::kDamping, "damping"},
           {Count::kJointLimit, "joint_limit"},
           {Count::kTiltStop, "tilt_stop"},
           {Count::kImuInvalid, "imu_invalid"},
           {Count::kImuBackwards, "imu_backwards"},
           {Count::kImuRepeated, "imu_repeated"},
           {Count::kImuGap, "imu_gap"},
           {Count::kImuSaturated, "imu_saturated"},
           {Count::kJointInvalid, "joint_invalid"},
           {Count::kSlip, "slip"},
           {Count::kEstimateRefused, "estimate_refused"},
           {Count::kFallbackMpc, "fallback_mpc"},
           {Count::kFallbackBody, "fallback_body"},
           {Count::kFallbackEstimator, "fallback_estimator"},
           {Count::kFallbackContact, "fallback_contact"},
           {Count::kFallbackFooting, "fallback_footing"},
           {Count::kFallbackLoad, "fallback_load"}}};
}

class Counters {
 public:
  [[nodiscard]] std::uint64_t operator[](Count what) const noexcept { return n_[Index(what)]; }
  void Add(Count what, std::uint64_t times = 1) noexcept { n_[Index(what)] += times; }
  Counters& operator+=(const Counters& other) noexcept {
    for (std::size_t i = 0; i < n_.size(); ++i) n_[i] += other.n_[i];
    return *this;
  }
  bool operator==(const Counters&) const = default;

 private:
  [[nodiscard]] static std::size_t Index(Count what) noexcept {
    return static_cast<std::size_t>(what);
  }
  std::array<std::uint64_t, EnumNames(Count{}).size()> n_{};
};

}  // namespace scoria
