// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <numbers>
#include <string_view>
#include <utility>

/// Units of logs, and what a value in them is multiplied by to be in SI.
namespace scoria::logs {

template <class Unit, std::size_t N>
using UnitNames = std::array<std::pair<Unit, std::string_view>, N>;

enum class AngleUnit { kRad, kDeg };
constexpr UnitNames<AngleUnit, 2> EnumNames(AngleUnit) {
  return {{{AngleUnit::kRad, "rad"}, {AngleUnit::kDeg, "deg"}}};
}
constexpr double ToSi(AngleUnit unit) {
  return unit == AngleUnit::kDeg ? std::numbers::pi / 180.0 : 1.0;
}

enum class RateUnit { kRadPerS, kDegPerS };
constexpr UnitNames<RateUnit, 2> EnumNames(RateUnit) {
  return {{{RateUnit::kRadPerS, "rad/s"}, {RateUnit::kDegPerS, "deg/s"}}};
}
constexpr double ToSi(RateUnit unit) {
  return unit == RateUnit::kDegPerS ? std::numbers::pi / 180.0 : 1.0;
}

enum class LengthUnit { kM, kCm, kMm };
constexpr UnitNames<LengthUnit, 3> EnumNames(LengthUnit) {
  return {{{LengthUnit::kM, "m"}, {LengthUnit::kCm, "cm"}, {LengthUnit::kMm, "mm"}}};
}
constexpr double ToSi(LengthUnit unit) {
  return unit == LengthUnit::kMm ? 1e-3 : unit == LengthUnit::kCm ? 1e-2 : 1.0;
}

enum class SpeedUnit { kMPerS, kCmPerS, kMmPerS };
constexpr UnitNames<SpeedUnit, 3> EnumNames(SpeedUnit) {
  return {{{SpeedUnit::kMPerS, "m/s"}, {SpeedUnit::kCmPerS, "cm/s"}, {SpeedUnit::kMmPerS, "mm/s"}}};
}
constexpr double ToSi(SpeedUnit unit) {
  return unit == SpeedUnit::kMmPerS ? 1e-3 : unit == SpeedUnit::kCmPerS ? 1e-2 : 1.0;
}

enum class AccelerationUnit { kMPerS2, kG };
constexpr UnitNames<AccelerationUnit, 2> EnumNames(AccelerationUnit) {
  return {{{AccelerationUnit::kMPerS2, "m/s2"}, {AccelerationUnit::kG, "g"}}};
}
/// Standard gravity, of which "g" is a multiple.
constexpr double ToSi(AccelerationUnit unit) {
  return unit == AccelerationUnit::kG ? 9.80665 : 1.0;
}

enum class TorqueUnit { kNm, kMilliNm };
constexpr UnitNames<TorqueUnit, 2> EnumNames(TorqueUnit) {
  return {{{TorqueUnit::kNm, "Nm"}, {TorqueUnit::kMilliNm, "mNm"}}};
}
constexpr double ToSi(TorqueUnit unit) { return unit == TorqueUnit::kMilliNm ? 1e-3 : 1.0; }

enum class MassUnit { kKg, kGram };
constexpr UnitNames<MassUnit, 2> EnumNames(MassUnit) {
  return {{{MassUnit::kKg, "kg"}, {MassUnit::kGram, "g"}}};
}
constexpr double ToSi(MassUnit unit) { return unit == MassUnit::kGram ? 1e-3 : 1.0; }

enum class VoltageUnit { kV, kMv };
constexpr UnitNames<VoltageUnit, 2> EnumNames(VoltageUnit) {
  return {{{VoltageUnit::kV, "V"}, {VoltageUnit::kMv, "mV"}}};
}
constexpr double ToSi(VoltageUnit unit) { return unit == VoltageUnit::kMv ? 1e-3 : 1.0; }

enum class CurrentUnit { kA, kMa };
constexpr UnitNames<CurrentUnit, 2> EnumNames(CurrentUnit) {
  return {{{CurrentUnit::kA, "A"}, {CurrentUnit::kMa, "mA"}}};
}
constexpr double ToSi(CurrentUnit unit) { return unit == CurrentUnit::kMa ? 1e-3 : 1.0; }

enum class TimeUnit { kS, kMs, kUs, kNs };
constexpr UnitNames<TimeUnit, 4> EnumNames(TimeUnit) {
  return {
      {{TimeUnit::kS, "s"}, {TimeUnit::kMs, "ms"}, {TimeUnit::kUs, "us"}, {TimeUnit::kNs, "ns"}}};
}
constexpr double ToSi(TimeUnit unit) {
  constexpr std::array kFactors = {1.0, 1e-3, 1e-6, 1e-9};
  return kFactors[static_cast<std::size_t>(unit)];
}

}  // namespace scoria::logs
