// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/signal_values.h"

namespace scoria::logs {
namespace {

template <class Values>
std::span<const double> Span(const std::optional<Values>& values) noexcept {
  if (!values) return {};
  return *values;
}
std::span<const double> Span(const std::optional<double>& value) noexcept {
  if (!value) return {};
  return {&*value, 1};
}

std::span<const double> MeasuredValues(const MeasuredRow& row, SignalId signal) noexcept {
  switch (signal) {
    case SignalId::kJointQ:
      return Span(row.q_rad);
    case SignalId::kJointQd:
      return Span(row.qd_radps);
    case SignalId::kJointTau:
      return Span(row.tau_Nm);
    case SignalId::kImuAttitude:
      return Span(row.rpy_WS_rad);
    case SignalId::kImuRate:
      return Span(row.w_WS_S_radps);
    case SignalId::kImuAcceleration:
      return Span(row.a_WS_S_mps2);
    case SignalId::kFootForce:
      return Span(row.foot_force_counts);
    case SignalId::kBatteryVoltage:
      return Span(row.battery_V);
    case SignalId::kBatteryCurrent:
      return Span(row.battery_A);
    default:
      return {};
  }
}

}  // namespace

std::span<const double> ValuesOf(const Row& row, SignalId signal) noexcept {
  if (signal <= SignalId::kBatteryCurrent)
    return row.measured ? MeasuredValues(*row.measured, signal) : std::span<const double>();
  switch (signal) {
    case SignalId::kEstimatePosition:
      return row.estimate ? std::span<const double>(row.estimate->p_WB_m)
                          : std::span<const double>();
    case SignalId::kEstimateVelocity:
      return row.estimate ? std::span<const double>(row.estimate->v_WB_mps)
                          : std::span<const double>();
    case SignalId::kEstimateAttitude:
      return row.estimate ? std::span<const double>(row.estimate->rpy_rad)
                          : std::span<const double>();
    case SignalId::kTruthPosition:
      return row.truth ? std::span<const double>(row.truth->p_WB_m) : std::span<const double>();
    case SignalId::kTruthVelocity:
      return row.truth ? std::span<const double>(row.truth->v_WB_mps) : std::span<const double>();
    case SignalId::kTruthRate:
      return row.truth ? std::span<const double>(row.truth->w_WB_radps) : std::span<const double>();
    case SignalId::kTruthAttitude:
      return row.truth ? std::span<const double>(row.truth->rpy_rad) : std::span<const double>();
    default:
      return {};
  }
}

}  // namespace scoria::logs
