// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/archive.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

struct SwingParams {
  double apex_m = 0.08;
  double retarget_until = 0.9;
  double lower_speed_mps = 0.5;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("apex_m", apex_m,
            {.min = 0.0, .max = 0.5, .doc = "height over the higher end of the step"});
    a.Field("retarget_until", retarget_until,
            {.min = 0.0, .max = 1.0, .doc = "swing progress after which the foothold is fixed"});
    a.Field("lower_speed_mps", lower_speed_mps,
            {.min = 0.01, .max = 5.0, .doc = "of a late foot under late_contact: lower"});
  }
};

/// Moves swing feet along cubic Bezier curves from lift-off to foothold, in height up to the apex
/// and down again. Late feet go straight down at lower_speed until they touch. Source: paper, swing
/// leg controller; polynomials as the reference's (3s² − 2s³).
class SwingTrajectory {
 public:
  /// `robot` is borrowed.
  SwingTrajectory(const SwingParams& params, const core::RobotDescription& robot) noexcept
      : params_(params), robot_(robot) {}

  [[nodiscard]] FootTargets Plan(const core::WholeBody& wb, const LegPhases& legs,
                                 const FootholdPlan& footholds) noexcept;

 private:
  SwingParams params_;
  const core::RobotDescription& robot_;
  LegArray<Vec3> lift_off_W_ = ZeroPerLeg();
  LegArray<Vec3> goal_W_ = ZeroPerLeg();
  LegArray<LegMode> last_mode_{LegMode::kStance};
};

}  // namespace scoria::controller
