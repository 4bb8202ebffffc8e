// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "core/robot/description.h"
#include "logs/mapping/signals.h"
#include "logs/row.h"

namespace scoria::logs {

/// Whose account of the trunk's motion it is.
enum class MotionSource { kImu, kEstimate, kTruth };
/// The attitude of each.
inline constexpr std::array kAttitudeSignals = {SignalId::kImuAttitude, SignalId::kEstimateAttitude,
                                                SignalId::kTruthAttitude};
inline constexpr std::size_t kNumMotionSources = 3;
template <class T>
using PerSource = std::array<std::optional<T>, kNumMotionSources>;

/// What the checks by physics need of an instant, in B and W. What no sensor can have measured
/// (see IsPlausible) is absent.
struct Tick {
  double time_s = 0.0;
  bool is_first = true;  // after an interruption: what came before is no neighbour
  std::optional<LegArray<Vec3>> q = std::nullopt, qd = std::nullopt, tau = std::nullopt;
  std::optional<Vec3> w_WB_B = std::nullopt;  // by the gyroscope
  std::optional<Vec3> a_WS_B = std::nullopt;  // specific force, by the accelerometer
  PerSource<Mat3> R_WB = {};
  PerSource<Vec3> rpy_rad = {};          // as read
  PerSource<Vec3> p_WB = {}, v_WB = {};  // as read; none by the IMU
  std::optional<Vec3> w_true = std::nullopt;
  std::optional<PerLeg<double>> foot_force = std::nullopt;
};

/// @param robot  where the IMU is; null: at the trunk's axes.
[[nodiscard]] Tick MakeTick(const Row& row, const core::RobotDescription* robot);

/// The instant between two, by the share `s` in [0, 1] of the way; what one of them lacks is
/// absent.
[[nodiscard]] Tick Interpolate(const Tick& a, const Tick& b, double s);

/// The rate of the trunk in B by whoever measured it: the gyroscope, else the truth.
[[nodiscard]] std::optional<Vec3> RateOf(const Tick& tick);

/// The attitude by the IMU's filter, else the estimate, else the truth.
[[nodiscard]] std::optional<Mat3> AttitudeOf(const Tick& tick);

/// The velocity of the trunk in W by the truth, else the estimate.
[[nodiscard]] std::optional<Vec3> VelocityOf(const Tick& tick);

}  // namespace scoria::logs
