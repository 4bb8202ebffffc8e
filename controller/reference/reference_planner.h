// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"
#include "core/robot/local_ground.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

/// Of a low pass that goes this share of the way in every tick of 10 ms.
[[nodiscard]] double TimeConstantOfTickGain_s(double gain);

struct ReferenceParams {
  double max_yaw_lead_rad = 0.3;
  double max_position_lead_m = 0.10;
  double tilt_share = 0.6;
  double plane_slope_s = 0.095, plane_height_s = 0.0615;
  double max_acceleration_mps2 = 1.0;
  double max_yaw_acceleration_radps2 = 3.0;
  double stand_dither_m = 0.0, stand_dither_Hz = 0.5;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field(
        "max_yaw_lead_rad", max_yaw_lead_rad,
        {.min = 0.0, .max = 3.0, .doc = "how far the desired heading may run from the measured"});
    a.Field("max_position_lead_m", max_position_lead_m,
            {.min = 0.0, .max = 1.0, .scale = core::dimension::kLength});
    a.Field("tilt_share", tilt_share,
            {.min = 0.0, .max = 1.0, .doc = "share of the ground's tilt that the trunk follows"});
    a.Field("plane_slope_s", plane_slope_s,
            {.min = 0.0,
             .max = 60.0,
             .doc = "time constant of the ground plane's slope",
             .was = "plane_slope_gain",
             .from_was = TimeConstantOfTickGain_s,
             .scale = core::dimension::kTime});
    a.Field("plane_height_s", plane_height_s,
            {.min = 0.0,
             .max = 60.0,
             .doc = "time constant of the ground plane's height",
             .was = "plane_height_gain",
             .from_was = TimeConstantOfTickGain_s,
             .scale = core::dimension::kTime});
    a.Field("max_acceleration_mps2", max_acceleration_mps2,
            {.min = 0.05, .max = 20.0, .doc = "ramp of commanded speeds"});
    a.Field("max_yaw_acceleration_radps2", max_yaw_acceleration_radps2,
            {.min = 0.05, .max = 50.0, .scale = core::Pow(core::dimension::kTime, -2.0)});
    a.Field(
        "stand_dither_m", stand_dither_m,
        {.min = 0.0,
         .max = 0.1,
         .doc = "without a command the trunk goes up and down by this, so that the joints slide "
                "and their friction does not read as mass",
         .scale = core::dimension::kLength});
    a.Field("stand_dither_Hz", stand_dither_Hz,
            {.min = 0.01, .max = 5.0, .scale = core::dimension::kRate});
  }
  bool operator==(const ReferenceParams&) const = default;
};

/// Desired body motion from the operator's command: position and heading integrate the command,
/// held near the measured ones, so that a standing robot does not drift and a blocked one does not
/// wind up; height and tilt follow the plane through the last footholds.
class ReferencePlanner {
 public:
  ReferencePlanner(const ReferenceParams& params, double nominal_height_m) noexcept
      : params_(params), nominal_height_m_(nominal_height_m) {}

  /// Tells where the feet that are down stand; call before Plan.
  /// @param foot_radius_m lowers the footholds to the ground.
  /// @param dt_s          since the last call.
  void ObserveFeet(const core::WholeBody& wb, const LegArray<bool>& contact, double foot_radius_m,
                   double dt_s) noexcept;

  /// Where the ground is known, in place of ObserveFeet: the plane is the one through the ground
  /// below the four feet, at once.
  void ObserveGround(const core::WholeBody& wb, const LocalGround& ground) noexcept;

  [[nodiscard]] BodyReference Plan(const core::WholeBody& wb, const Command& command, int horizon,
                                   double stage_s, double dt_s) noexcept;

  [[nodiscard]] const GroundPlane& plane() const noexcept { return plane_; }

  void set_params(const ReferenceParams& params) noexcept { params_ = params; }

 private:
  void Ramp(const Command& command, double dt_s) noexcept;
  void AdvanceDither(double dt_s) noexcept;
  void FitPlane(const Vec3& p_WB, double slope_share, double height_share) noexcept;

  ReferenceParams params_;
  double nominal_height_m_;
  bool started_ = false;
  LegArray<Vec3> foothold_W_ = ZeroPerLeg();  // last ground contact of each foot
  GroundPlane plane_;
  Vec2 p_desired_W_ = Vec2::Zero();
  double yaw_desired_rad_ = 0.0;
  Vec2 v_H_ = Vec2::Zero();
  double w_z_ = 0.0;
  double dither_rad_ = 0.0;  // 0 while the command is to move
  double dither_m_ = 0.0;
};

}  // namespace scoria::controller
