// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/payload_body.h"

#include "core/math/so3.h"

namespace scoria::core {
namespace {

/// Principal moments of a solid box.
Vec3 BoxInertia(double mass_kg, const Vec3& size_m) noexcept {
  const Vec3 squares = size_m.cwiseProduct(size_m);
  return mass_kg / 12.0 * (Vec3::Constant(squares.sum()) - squares);
}

bool HasZero(const Vec3& v) { return (v.array() == 0.0).any(); }

}  // namespace

std::string PayloadParams::Problem() const {
  // Rounding of hand-written moments, e.g. of a thin plate, where the triangle closes.
  constexpr double kRounding = 1e-6;
  if (name.empty()) return "name: must not be empty";
  if (size_m != Vec3::Zero() && HasZero(size_m)) return "size_m: either all edges are 0 or none";
  if (inertia_kgm2 == Vec3::Zero()) return "";
  if (2.0 * inertia_kgm2.maxCoeff() > (1.0 + kRounding) * inertia_kgm2.sum())
    return "inertia_kgm2: no body has a moment greater than the sum of the other two";
  return "";
}

SpatialInertia ToInertia(const PayloadParams& payload) noexcept {
  const bool is_given = payload.inertia_kgm2 != Vec3::Zero();
  const Vec3 moments =
      is_given ? payload.inertia_kgm2 : BoxInertia(payload.mass_kg, payload.size_m);
  const Mat3 R_BP = RotationFromRpy(payload.rpy_rad);
  return {payload.mass_kg, payload.p_BP_m, R_BP * moments.asDiagonal() * R_BP.transpose()};
}

}  // namespace scoria::core
