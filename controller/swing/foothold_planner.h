// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"
#include "core/math/moving_mean.h"
#include "core/robot/local_ground.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

struct FootholdParams {
  double velocity_gain_s = 0.1;
  int velocity_filter_samples = 20;
  double max_reach_m = 0.28;
  double max_step_height_m = 0.15;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("velocity_gain_s", velocity_gain_s,
            {.min = 0.0,
             .max = 1.0,
             .doc = "step out per velocity error (Raibert)",
             .scale = core::dimension::kTime});
    a.Field("velocity_filter_samples", velocity_filter_samples, {.min = 1, .max = 100});
    a.Field("max_reach_m", max_reach_m,
            {.min = 0.05,
             .max = 1.0,
             .doc = "horizontal distance from the neutral foothold",
             .scale = core::dimension::kLength});
    a.Field("max_step_height_m", max_step_height_m,
            {.min = 0.01,
             .max = 1.0,
             .doc = "a higher or lower step than this is shortened towards the last foothold",
             .scale = core::dimension::kLength});
  }
  bool operator==(const FootholdParams&) const = default;
};

/// Footholds after Raibert with the centrifugal term:
///   p = p_neutral(touchdown) + T_stance/2 v + k (v − v_cmd) + ½ √(h/g) v × ω_cmd,
/// on the ground plane, clipped to the reach along the direction from the neutral foothold, and
/// shortened where the plane asks for a step above reach.
/// Source: [Raibert1986], [Kim2019].
class FootholdPlanner {
 public:
  FootholdPlanner(const FootholdParams& params, const core::RobotDescription& robot,
                  double gravity_mps2) noexcept;

  /// @param ground  where the ground is known: footholds lie on it instead of on the plane.
  [[nodiscard]] FootholdPlan Plan(const core::WholeBody& wb, const ContactPlan& contacts,
                                  const LegPhases& legs, const BodyReference& reference,
                                  const GroundPlane& plane,
                                  const LocalGround* ground = nullptr) noexcept;

  /// Level distance of a foot from its place under the body as it is.
  [[nodiscard]] double DistanceFromNeutral(const core::WholeBody& wb, Leg leg) const noexcept;

  void set_params(const FootholdParams& params) noexcept {
    params_ = params;
    velocity_ = core::MovingMean<Vec3, kMaxSamples>(params.velocity_filter_samples);
  }

 private:
  /// What one tick's footholds have in common.
  struct Tick {
    const core::WholeBody& wb;
    const ContactPlan& contacts;
    const BodyReference::Stage& reference;
    const GroundPlane& plane;
    const LocalGround* ground;
    Vec3 v_W;  // filtered velocity of the COM
    double height_m, yaw_rad;
    [[nodiscard]] double GroundHeight(const Vec3& p_W) const noexcept {
      return ground != nullptr ? ground->Height(wb.state, p_W) : plane.Height(p_W);
    }
  };
  [[nodiscard]] Vec3 TouchdownAfter(const Tick& tick, Leg leg, double delay_s) const noexcept;

  static constexpr int kMaxSamples = 100;
  FootholdParams params_;
  const core::RobotDescription& robot_;
  double gravity_mps2_;
  core::MovingMean<Vec3, kMaxSamples> velocity_;
  LegArray<Vec3> last_W_ = ZeroPerLeg();  // where each foot stands or last stood
  bool started_ = false;
};

}  // namespace scoria::controller
