// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"
#include "core/math/types.h"

namespace scoria::controller {

/// How an estimator finds its first attitude.
struct RestParams {
  double window_s = 0.2;
  double smooth_s = 0.01;
  double max_rate_radps = 0.02, max_force_mps2 = 0.15;
  double patience_s = 3.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("window_s", window_s,
            {.min = 0.01, .max = 10.0, .doc = "of rest, over which gravity is averaged"});
    a.Field("smooth_s", smooth_s,
            {.min = 1e-4, .max = 1.0, .doc = "against noise, before the two limits below"});
    a.Field("max_rate_radps", max_rate_radps,
            {.min = 1e-4, .max = 10.0, .doc = "a rate further from its mean ends the rest"});
    a.Field("max_force_mps2", max_force_mps2,
            {.min = 1e-3, .max = 100.0, .doc = "a specific force further from its mean likewise"});
    a.Field("patience_s", patience_s,
            {.min = 0.0,
             .max = 60.0,
             .doc = "without rest, the start is made from what there is",
             .scale = core::dimension::kTime});
  }
  bool operator==(const RestParams&) const = default;
};

/// Mean specific force and rate of an IMU since it came to rest: attitude and turn-on bias of the
/// gyroscope follow from them.
class RestAttitude {
 public:
  explicit RestAttitude(const RestParams& params) noexcept : params_(params) {}

  void Add(const Vec3& a_WS_S, const Vec3& w_WS_S, double dt_s) noexcept;

  /// Has been at rest for the window, or was waited for too long.
  [[nodiscard]] bool IsReady() const noexcept {
    return rest_s_ >= params_.window_s || waited_s_ >= params_.patience_s;
  }
  /// Attitude in which the mean specific force points up, with B's heading `yaw_rad`.
  [[nodiscard]] Mat3 R_WB(const Mat3& R_BS, double yaw_rad) const noexcept;
  /// Zero unless it was at rest.
  [[nodiscard]] Vec3 GyroBias_S() const noexcept;

 private:
  RestParams params_;
  double rest_s_ = 0.0, waited_s_ = 0.0;
  Vec3 smooth_a_S_ = Vec3::Zero(), smooth_w_S_ = Vec3::Zero();
  Vec3 a_S_ = Vec3::UnitZ(), w_S_ = Vec3::Zero();  // means
};

}  // namespace scoria::controller
