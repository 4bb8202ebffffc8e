// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

struct SwingParams {
  double apex_m = 0.08;
  double retarget_until = 0.9;
  double lower_speed_mps = 0.5;
  double stumble_lift_m = 0.05;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("apex_m", apex_m,
            {.min = 0.0,
             .max = 0.5,
             .doc = "height over both ends of the step and the ground plane half-way",
             .scale = core::dimension::kLength});
    a.Field("retarget_until", retarget_until,
            {.min = 0.0, .max = 1.0, .doc = "swing progress after which the foothold is fixed"});
    a.Field("lower_speed_mps", lower_speed_mps,
            {.min = 0.01,
             .max = 5.0,
             .doc = "of a foot that is lowered until it touches",
             .scale = core::dimension::kSpeed});
    a.Field("stumble_lift_m", stumble_lift_m,
            {.min = 0.0,
             .max = 0.3,
             .doc = "added to the apex by the stumble reflex",
             .scale = core::dimension::kLength});
  }
  bool operator==(const SwingParams&) const = default;
};

/// Moves swing feet along cubic Bezier curves from lift-off to foothold, in height up to the apex
/// and down again; the apex counts from the highest of both ends and the ground plane between them.
/// A foot that stumbles starts anew from where it is, first upwards and then on. A foot that ought
/// to stand goes straight down at lower_speed until it touches, or stays where it is in the body
/// frame. Source: paper, swing leg controller; polynomials as the reference's (3s² − 2s³).
class SwingTrajectory {
 public:
  /// `robot` is borrowed.
  SwingTrajectory(const SwingParams& params, const core::RobotDescription& robot) noexcept
      : params_(params), robot_(robot) {}

  /// @param lift_m  added to the apex of swings that begin.
  [[nodiscard]] FootTargets Plan(const core::WholeBody& wb, const LegPhases& legs,
                                 const FootholdPlan& footholds, double lift_m = 0.0) noexcept;

  void set_params(const SwingParams& params) noexcept { params_ = params; }

 private:
  /// What a swing was started with.
  struct Arc {
    LegMode mode = LegMode::kStance;
    Vec3 from_W = Vec3::Zero(), to_W = Vec3::Zero();
    Vec3 held_B = Vec3::Zero();  // where a held foot is in the body frame
    double start = 0.0;          // swing progress at `from_W`
    double pause = 0.0;          // share of the rest that goes upwards only
    double lift_m = 0.0;         // on top of the apex
  };
  [[nodiscard]] Arc StartArc(const core::WholeBody& wb, const LegPhases& legs, Leg leg,
                             const Vec3& to_W) const noexcept;
  [[nodiscard]] FootTarget AlongArc(const Arc& arc, const LegPhases& legs, Leg leg,
                                    double ground_z_m) const noexcept;
  [[nodiscard]] FootTarget Wait(const core::WholeBody& wb, const LegPhases& legs, Leg leg,
                                const Arc& arc) const noexcept;

  SwingParams params_;
  const core::RobotDescription& robot_;
  LegArray<Arc> arcs_;
};

}  // namespace scoria::controller
