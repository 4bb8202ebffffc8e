// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <span>

#include "logs/mapping/signals.h"
#include "logs/row.h"

namespace scoria::logs {

/// Signals that a sensor, an estimator or a truth measures; attitudes are roll, pitch, yaw.
inline constexpr std::array kMeasuredSignals = {
    SignalId::kJointQ,           SignalId::kJointQd,          SignalId::kJointTau,
    SignalId::kImuAttitude,      SignalId::kImuRate,          SignalId::kImuAcceleration,
    SignalId::kFootForce,        SignalId::kBatteryVoltage,   SignalId::kBatteryCurrent,
    SignalId::kEstimatePosition, SignalId::kEstimateVelocity, SignalId::kEstimateAttitude,
    SignalId::kTruthPosition,    SignalId::kTruthVelocity,    SignalId::kTruthRate,
    SignalId::kTruthAttitude,
};

/// The numbers of one of kMeasuredSignals in a row; empty where the row has none. They are the
/// row's own.
[[nodiscard]] std::span<const double> ValuesOf(const Row& row, SignalId signal) noexcept;

}  // namespace scoria::logs
