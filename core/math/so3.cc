// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/so3.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scoria::core {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSmallAngle_rad = 1e-4;  // the series' next terms are below 1e-17 here

}  // namespace

Mat3 Skew(const Vec3& v) noexcept {
  Mat3 S;
  S << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return S;
}

Mat3 ExpSo3(const Vec3& phi) noexcept {
  const double t2 = phi.squaredNorm();
  const double t = std::sqrt(t2);
  const bool small = t < kSmallAngle_rad;
  const double a = small ? 1.0 - t2 / 6.0 : std::sin(t) / t;
  const double b = small ? 0.5 - t2 / 24.0 : (1.0 - std::cos(t)) / t2;
  const Mat3 S = Skew(phi);
  return Mat3::Identity() + a * S + b * S * S;
}

Vec3 LogSo3(const Mat3& R) noexcept {
  Quat q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double n = q.vec().norm();
  // 2 atan2(n, w) / n tends to 2 / w as n -> 0.
  const double scale = n < kSmallAngle_rad ? 2.0 / q.w() * (1.0 - n * n / (3.0 * q.w() * q.w()))
                                           : 2.0 * std::atan2(n, q.w()) / n;
  return scale * q.vec();
}

Mat3 RotationFromRpy(const Vec3& rpy_rad) noexcept {
  return (Eigen::AngleAxisd(rpy_rad.z(), Vec3::UnitZ()) *
          Eigen::AngleAxisd(rpy_rad.y(), Vec3::UnitY()) *
          Eigen::AngleAxisd(rpy_rad.x(), Vec3::UnitX()))
      .toRotationMatrix();
}

Vec3 RpyFromRotation(const Mat3& R) noexcept {
  const double sin_pitch = std::clamp(-R(2, 0), -1.0, 1.0);
  const double pitch = std::asin(sin_pitch);
  constexpr double kGimbal = 1.0 - 1e-12;
  if (std::abs(sin_pitch) > kGimbal) return {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

Mat3 RotationZ(double yaw_rad) noexcept {
  const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
  Mat3 R;
  R << c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0;
  return R;
}

double UnwrapNear(double angle_rad, double near_rad) noexcept {
  return near_rad + WrapToPi(angle_rad - near_rad);
}

double WrapToPi(double angle_rad) noexcept {
  const double r = std::remainder(angle_rad, 2.0 * kPi);
  return r <= -kPi ? r + 2.0 * kPi : r;
}

}  // namespace scoria::core
