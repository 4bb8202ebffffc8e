// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "controller/safety/supervisor.h"
#include "core/robot/contact.h"
#include "core/robot/plans.h"

namespace scoria::controller {

struct QualityParams {
  double body_window_s = 0.05;
  double nis_window_s = 0.3;
  double acceleration_window_s = 0.5, acceleration_mps2 = 1.5;
  double load_window_s = 0.5, load_shortfall = 0.1;
  double footing_window_s = 2.0;
  double stumbles = 3.0, stumble_m = 0.04;
  double tilt_rad = 0.25;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("body_window_s", body_window_s,
            {.min = 0.0, .max = 10.0, .doc = "low pass", .scale = core::dimension::kTime});
    a.Field("nis_window_s", nis_window_s,
            {.min = 0.0,
             .max = 10.0,
             .doc = "low pass of the innovations",
             .scale = core::dimension::kTime});
    a.Field("acceleration_window_s", acceleration_window_s,
            {.min = 0.01,
             .max = 10.0,
             .doc = "over which acceleration and speed must agree",
             .scale = core::dimension::kTime});
    a.Field(
        "acceleration_mps2", acceleration_mps2,
        {.min = 1e-3, .max = 100.0, .doc = "difference between the two that leaves no quality"});
    a.Field("load_window_s", load_window_s,
            {.min = 0.0, .max = 10.0, .doc = "low pass", .scale = core::dimension::kTime});
    a.Field("load_shortfall", load_shortfall,
            {.min = 0.01,
             .max = 10.0,
             .doc = "torque that a stance leg lacks, over its limit, that leaves no quality"});
    a.Field("footing_window_s", footing_window_s,
            {.min = 0.01,
             .max = 60.0,
             .doc = "over which slips and stumbles are forgotten",
             .scale = core::dimension::kTime});
    a.Field("stumbles", stumbles,
            {.min = 0.1,
             .max = 1e4,
             .doc = "slips and stumbles in it that leave no quality",
             .was = "mishaps"});
    a.Field("stumble_m", stumble_m,
            {.min = 0.0,
             .max = 1.0,
             .doc = "a swing foot that touches and lags so far behind has stumbled",
             .scale = core::dimension::kLength});
    a.Field("tilt_rad", tilt_rad,
            {.min = 0.01, .max = 3.2, .doc = "error of the trunk's tilt that leaves no quality"});
  }
  bool operator==(const QualityParams&) const = default;
};

/// What the stages say of themselves in one tick of the body controller.
struct StageReports {
  double plan_age_share = 0.0;    // age of the force plan over the greatest allowed
  bool body_answered = true;      // solved, usable and in time
  double torque_shortfall = 0.0;  // of a stance leg's motor: beyond its limit, as a share of that
  bool estimate_finite = true;
  Vec3 v_W = Vec3::Zero(), a_W = Vec3::Zero();  // of the trunk: as estimated; by the accelerometer
  double nis = 0.0;                             // of the last correction by the feet
  int nis_dof = 0;                              // 0: there was none
  double sound_feet_share = 1.0;                // whose chosen contact source is sound
  double tilt_error_rad = 0.0;                  // of the trunk, against the reference
  std::uint64_t slips = 0;                      // since the start
  const LegPhases& legs;
  const LegArray<bool>& contact;  // sensed
  LegArray<double> foot_lag_m;    // from where a swing foot should be
};

/// Turns reports into the qualities that the supervisor judges.
class StageQuality {
 public:
  explicit StageQuality(const QualityParams& params) noexcept : params_(params) {}
  [[nodiscard]] const Qualities& Update(const StageReports& reports, double dt_s) noexcept;
  [[nodiscard]] const Qualities& qualities() const noexcept { return qualities_; }
  /// Acceleration by the accelerometer less that of the estimated speed, both low-passed, m/s², in
  /// W.
  [[nodiscard]] const Vec3& acceleration_residual_W() const noexcept {
    return acceleration_residual_W_;
  }
  void set_params(const QualityParams& params) noexcept { params_ = params; }

 private:
  [[nodiscard]] double CalcEstimator(const StageReports& reports, double dt_s) noexcept;
  [[nodiscard]] double CalcFooting(const StageReports& reports, double dt_s) noexcept;

  QualityParams params_;
  Qualities qualities_{1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
  double answered_ = 1.0, nis_ratio_ = 1.0, spare_ = 1.0, stumbles_ = 0.0;
  Vec3 mean_v_W_ = Vec3::Zero(), mean_a_W_ = Vec3::Zero(), acceleration_residual_W_ = Vec3::Zero();
  bool started_ = false;
  std::uint64_t slips_ = 0;
  LegArray<bool> stumbled_;  // in this swing
};

}  // namespace scoria::controller
