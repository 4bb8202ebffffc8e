// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/rest_attitude.h"

#include <algorithm>
#include <cmath>

#include "core/math/so3.h"

namespace scoria::controller {

void RestAttitude::Add(const Vec3& a_WS_S, const Vec3& w_WS_S, double dt_s) noexcept {
  if (dt_s == 0.0) return;
  const double blend = waited_s_ == 0.0 ? 1.0 : dt_s / (dt_s + params_.smooth_s);
  waited_s_ += dt_s;
  smooth_a_S_ += blend * (a_WS_S - smooth_a_S_);
  smooth_w_S_ += blend * (w_WS_S - smooth_w_S_);
  const bool moves = (smooth_w_S_ - w_S_).norm() > params_.max_rate_radps ||
                     (smooth_a_S_ - a_S_).norm() > params_.max_force_mps2;
  rest_s_ = moves ? dt_s : rest_s_ + dt_s;
  // A mean since the rest began; later a moving one.
  const double gain = dt_s / std::min(rest_s_, params_.window_s);
  a_S_ += gain * ((moves ? smooth_a_S_ : a_WS_S) - a_S_);
  w_S_ += gain * ((moves ? smooth_w_S_ : w_WS_S) - w_S_);
}

Vec3 RestAttitude::GyroBias_S() const noexcept {
  return rest_s_ >= params_.window_s ? w_S_ : Vec3::Zero();
}

Mat3 RestAttitude::R_WB(const Mat3& R_BS, double yaw_rad) const noexcept {
  const Vec3 up_B = (R_BS * a_S_).normalized();
  const double roll = std::atan2(up_B.y(), up_B.z());
  const double pitch = std::atan2(-up_B.x(), std::hypot(up_B.y(), up_B.z()));
  return core::RotationFromRpy({roll, pitch, yaw_rad});
}

}  // namespace scoria::controller
