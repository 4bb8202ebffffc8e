// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/math/types.h"

namespace scoria::core {

/// Skew(a) * b == a.cross(b).
[[nodiscard]] Mat3 Skew(const Vec3& v) noexcept;

/// Exponential map of SO(3): rotation by |phi| rad about phi. Rodrigues' formula; Taylor series
/// below 1e-4 rad. Source: [Sola2018] eq. (132).
[[nodiscard]] Mat3 ExpSo3(const Vec3& phi) noexcept;

/// Logarithm of SO(3): phi with |phi| <= pi and ExpSo3(phi) == R. Well defined at pi, where the
/// sign is free. Source: [Sola2018] eq. (133), by way of the unit quaternion so that it stays
/// accurate at pi.
[[nodiscard]] Vec3 LogSo3(const Mat3& R) noexcept;

/// Rz(yaw) Ry(pitch) Rx(roll), angles [roll, pitch, yaw] in rad.
[[nodiscard]] Mat3 RotationFromRpy(const Vec3& rpy_rad) noexcept;

/// [roll, pitch, yaw] in rad with pitch in [-pi/2, pi/2]. At |pitch| = pi/2 roll is 0 by choice.
[[nodiscard]] Vec3 RpyFromRotation(const Mat3& R) noexcept;

/// Rotation about +z by `yaw_rad`.
[[nodiscard]] Mat3 RotationZ(double yaw_rad) noexcept;

/// The angle equal to `angle_rad` modulo 2 pi that is nearest to `near_rad`.
[[nodiscard]] double UnwrapNear(double angle_rad, double near_rad) noexcept;

/// The angle in (-pi, pi].
[[nodiscard]] double WrapToPi(double angle_rad) noexcept;

}  // namespace scoria::core
