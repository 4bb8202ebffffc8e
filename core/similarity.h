// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace scoria::core {

/// Exponents of a physical unit, kg^mass m^length s^time; radians and counts have none.
struct Dimension {
  double mass = 0.0, length = 0.0, time = 0.0;
  bool operator==(const Dimension&) const = default;
};

constexpr Dimension operator*(const Dimension& a, const Dimension& b) noexcept {
  return {a.mass + b.mass, a.length + b.length, a.time + b.time};
}
constexpr Dimension Pow(const Dimension& a, double exponent) noexcept {
  return {exponent * a.mass, exponent * a.length, exponent * a.time};
}
constexpr Dimension operator/(const Dimension& a, const Dimension& b) noexcept {
  return a * Pow(b, -1.0);
}

namespace dimension {
inline constexpr Dimension kMass{1.0, 0.0, 0.0}, kLength{0.0, 1.0, 0.0}, kTime{0.0, 0.0, 1.0};
inline constexpr Dimension kSpeed = kLength / kTime, kRate = Pow(kTime, -1.0);
inline constexpr Dimension kForce = kMass * kLength / Pow(kTime, 2.0);
inline constexpr Dimension kTorque = kForce * kLength;       // also per radian
inline constexpr Dimension kJointDamping = kTorque * kTime;  // N m s / rad
inline constexpr Dimension kInertia = kMass * Pow(kLength, 2.0);
inline constexpr Dimension kMassMoment = kMass * kLength;
inline constexpr Dimension kPower = kTorque / kTime;
}  // namespace dimension

/// The size of a robot in units of the one whose numbers the defaults are, the Go2. By dynamic
/// similarity at equal gravity, where mass scales with s and length with l, time scales with √l
/// (equal Froude numbers), and every quantity by its unit. So the defaults of any robot are the
/// Go2's times one factor each. g is the Earth's, whatever gravity a scenario has.
/// Source: [Alexander1983].
struct Similarity {
  double mass = 1.0, length = 1.0;

  /// @param leg_m  thigh and shank. Within 1e-3 the Go2's own numbers are 1.
  [[nodiscard]] static Similarity Of(double mass_kg, double leg_m) noexcept;
  [[nodiscard]] bool IsReference() const noexcept { return mass == 1.0 && length == 1.0; }
  /// s^mass l^(length + time/2).
  [[nodiscard]] double Factor(const Dimension& dimension) const noexcept;
  bool operator==(const Similarity&) const = default;
};

/// How a default of this dimension goes with the robot, as "m L^1.5"; empty if not at all.
[[nodiscard]] std::string ScaleText(const Dimension& dimension);

}  // namespace scoria::core
