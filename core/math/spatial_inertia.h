// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/math/types.h"

namespace scoria::core {

/// Inertia of a rigid body: its mass, its centre of mass C, and its rotational inertia about C, in
/// the axes of a frame whose origin is O.
struct SpatialInertia {
  double mass_kg = 0.0;
  Vec3 p_OC = Vec3::Zero();
  Mat3 I_C = Mat3::Zero();  // kg m^2
  bool operator==(const SpatialInertia&) const = default;
};

/// m (|d|² 1 − d dᵀ): what a mass at d adds to the inertia about the origin, by the parallel-axis
/// theorem.
[[nodiscard]] inline Mat3 PointInertia(double mass_kg, const Vec3& d) noexcept {
  return mass_kg * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
}

/// Two bodies fixed to each other. @pre their masses have a positive sum.
[[nodiscard]] inline SpatialInertia Join(const SpatialInertia& a,
                                         const SpatialInertia& b) noexcept {
  SpatialInertia out;
  out.mass_kg = a.mass_kg + b.mass_kg;
  out.p_OC = (a.mass_kg * a.p_OC + b.mass_kg * b.p_OC) / out.mass_kg;
  out.I_C = a.I_C + b.I_C + PointInertia(a.mass_kg, a.p_OC - out.p_OC) +
            PointInertia(b.mass_kg, b.p_OC - out.p_OC);
  return out;
}

/// The same body in a frame P that sees O at p_PO, turned by R_PO.
[[nodiscard]] inline SpatialInertia Transform(const Mat3& R_PO, const Vec3& p_PO,
                                              const SpatialInertia& body) noexcept {
  return {body.mass_kg, p_PO + R_PO * body.p_OC, R_PO * body.I_C * R_PO.transpose()};
}

}  // namespace scoria::core
