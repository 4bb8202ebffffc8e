// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>

#include "core/math/types.h"

namespace scoria {

enum class Leg { kFL, kFR, kHL, kHR };
inline constexpr std::array<Leg, 4> kLegs = {Leg::kFL, Leg::kFR, Leg::kHL, Leg::kHR};
inline constexpr int kNumLegs = 4;

/// Joints of a leg in order: hip abduction (HAA), hip flexion (HFE), knee flexion (KFE).
enum class Joint { kHAA, kHFE, kKFE };
inline constexpr int kJointsPerLeg = 3;
inline constexpr int kNumJoints = kNumLegs * kJointsPerLeg;

[[nodiscard]] constexpr bool IsFront(Leg leg) noexcept {
  return leg == Leg::kFL || leg == Leg::kFR;
}
[[nodiscard]] constexpr bool IsLeft(Leg leg) noexcept { return leg == Leg::kFL || leg == Leg::kHL; }
[[nodiscard]] constexpr std::string_view LegName(Leg leg) noexcept {
  constexpr std::array<std::string_view, 4> kNames = {"FL", "FR", "HL", "HR"};
  return kNames[static_cast<std::size_t>(leg)];
}

/// One value per leg, indexed by Leg. Joint quantities are LegArray<Vec3> with components HAA, HFE,
/// KFE.
template <class T>
class LegArray {
 public:
  constexpr LegArray() = default;
  constexpr explicit LegArray(const T& value) { values_.fill(value); }
  constexpr LegArray(const T& fl, const T& fr, const T& hl, const T& hr)
      : values_{fl, fr, hl, hr} {}

  constexpr T& operator[](Leg leg) noexcept { return values_[static_cast<std::size_t>(leg)]; }
  constexpr const T& operator[](Leg leg) const noexcept {
    return values_[static_cast<std::size_t>(leg)];
  }
  constexpr auto begin() noexcept { return values_.begin(); }
  constexpr auto end() noexcept { return values_.end(); }
  constexpr auto begin() const noexcept { return values_.begin(); }
  constexpr auto end() const noexcept { return values_.end(); }
  bool operator==(const LegArray&) const = default;

 private:
  std::array<T, 4> values_{};
};

/// A LegArray<Vec3> of zeros (Eigen leaves its vectors uninitialised).
[[nodiscard]] inline LegArray<Vec3> ZeroPerLeg() noexcept { return LegArray<Vec3>(Vec3::Zero()); }

/// FL HAA, FL HFE, FL KFE, FR HAA ... as the log topics order them.
[[nodiscard]] inline std::array<double, kNumJoints> Flatten(const LegArray<Vec3>& v) noexcept {
  std::array<double, kNumJoints> flat{};
  auto out = flat.begin();
  for (const Vec3& leg : v) out = std::copy(leg.begin(), leg.end(), out);
  return flat;
}

/// Flatten, backwards.
[[nodiscard]] inline LegArray<Vec3> Unflatten(const std::array<double, kNumJoints>& flat) noexcept {
  LegArray<Vec3> v = ZeroPerLeg();
  auto in = flat.begin();
  for (Vec3& leg : v) {
    for (double& value : leg) value = *in++;
  }
  return v;
}

}  // namespace scoria
