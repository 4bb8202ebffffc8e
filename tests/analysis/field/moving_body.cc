// SPDX-License-Identifier: BSD-3-Clause
#include "tests/analysis/field/moving_body.h"

#include <cmath>

#include "core/math/so3.h"
#include "core/rng.h"
#include "logs/vectors.h"

namespace scoria::test {
namespace {

constexpr double kTrot_radps = 13.0;                      // 2.07 Hz
constexpr double kSlow_radps = 0.9, kFaster_radps = 2.1;  // of turning left and right

}  // namespace

Mat3 MovingBody::R_WB(double t_s) const {
  const double yaw = turning_radps * (std::sin(kSlow_radps * t_s) / kSlow_radps +
                                      0.5 * std::sin(kFaster_radps * t_s) / kFaster_radps);
  return core::RotationFromRpy({sway_rad * std::sin(kTrot_radps * t_s),
                                0.7 * sway_rad * std::sin(2.0 * kTrot_radps * t_s + 0.4), yaw});
}

Vec3 MovingBody::p_WB(double t_s) const {
  const double sway = speed_mps > 0.0 ? 0.01 : 0.0;
  return {speed_mps * t_s + sway * std::sin(kTrot_radps * t_s + 1.0),
          0.6 * speed_mps / kSlow_radps * std::sin(kSlow_radps * t_s),
          0.3 + sway * std::sin(2.0 * kTrot_radps * t_s)};
}

std::vector<logs::Row> MovingBody::Rows() const {
  constexpr double kStep_s = 1e-4, kDrift_mps = 0.03, kYaw_rad = 0.5;
  core::Rng rng(seed, 0, core::Stream::kSensor);
  const auto noise = [&](double size) {
    return Vec3(size * rng.NextNormal(), size * rng.NextNormal(), size * rng.NextNormal());
  };
  std::vector<logs::Row> rows;
  for (int k = 0; k < static_cast<int>(duration_s * rate_Hz); ++k) {
    const double t = k / rate_Hz, seen = t - delay_s;
    logs::Row row;
    row.time_s = t;
    const Mat3 R = R_WB(t);
    const Vec3 w =
        core::LogSo3(R_WB(t - kStep_s).transpose() * R_WB(t + kStep_s)) / (2.0 * kStep_s);
    const Vec3 a = (p_WB(t + kStep_s) - 2.0 * p_WB(t) + p_WB(t - kStep_s)) / (kStep_s * kStep_s);
    row.measured.emplace();
    row.measured->w_WS_S_radps = logs::ToArray(w + gyro_bias_radps + noise(gyro_noise_radps));
    row.measured->a_WS_S_mps2 =
        logs::ToArray(R.transpose() * (a + 9.81 * Vec3::UnitZ()) + accelerometer_bias_mps2 +
                      noise(accelerometer_noise_mps2));
    const Mat3 R_WM = R_WB(seen) * R_BM * core::ExpSo3(noise(attitude_noise_rad));
    row.truth.emplace();
    row.truth->p_WB_m = logs::ToArray(p_WB(seen) + R_WB(seen) * p_BM + noise(place_noise_m));
    row.truth->rpy_rad = logs::ToArray(core::RpyFromRotation(R_WM));
    row.estimate.emplace();
    row.estimate->p_WB_m =
        logs::ToArray(core::RotationZ(kYaw_rad) * (p_WB(t) + Vec3(kDrift_mps * t, 0.0, 0.0)));
    row.estimate->rpy_rad = logs::ToArray(core::RpyFromRotation(core::RotationZ(kYaw_rad) * R));
    rows.push_back(row);
  }
  return rows;
}

}  // namespace scoria::test
