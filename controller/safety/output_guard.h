// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"
#include "core/robot/counters.h"
#include "core/robot/description.h"
#include "core/robot/plans.h"
#include "core/robot/state.h"

namespace scoria::controller {

struct SafetyParams {
  double max_plan_age_s = 0.2;
  double max_command_age_s = 0.02;
  double tilt_stop_rad = 1.2;
  double damping_Nms_per_rad = 3.0;
  double joint_margin_rad = 0.0;
  Vec3 working_range_rad{0.9, 1.5, 0.95};
  double joint_limit_Nm_per_rad = 200.0, joint_limit_Nms_per_rad = 2.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("max_plan_age_s", max_plan_age_s,
            {.min = 0.0,
             .max = 5.0,
             .doc = "an older MPC plan is replaced by equal forces under all stance feet",
             .scale = core::dimension::kTime});
    a.Field("max_command_age_s", max_command_age_s,
            {.min = 0.0,
             .max = 1.0,
             .doc = "how long a late body controller's last command stays",
             .scale = core::dimension::kTime});
    a.Field(
        "tilt_stop_rad", tilt_stop_rad,
        {.min = 0.1, .max = 3.2, .doc = "beyond it the motors only damp, until the next start"});
    a.Field("damping_Nms_per_rad", damping_Nms_per_rad,
            {.min = 0.0, .max = 100.0, .scale = core::dimension::kJointDamping});
    a.Field("joint_margin_rad", joint_margin_rad,
            {.min = 0.0, .max = 0.5, .doc = "before a joint's limit, where it is turned back"});
    a.Field(
        "working_range_rad", working_range_rad,
        {.min = 0.1,
         .max = 10.0,
         .doc =
             "HAA, HFE, KFE: joints are also turned back so far from the standing pose, so that no "
             "leg folds through to where it cannot walk"});
    a.Field("joint_limit_Nm_per_rad", joint_limit_Nm_per_rad,
            {.min = 0.0, .max = 1e4, .scale = core::dimension::kTorque});
    a.Field("joint_limit_Nms_per_rad", joint_limit_Nms_per_rad,
            {.min = 0.0, .max = 100.0, .scale = core::dimension::kJointDamping});
  }
  bool operator==(const SafetyParams&) const = default;
};

/// How a command came about. Walking, joints also keep to the working range, and a tilt stop lasts
/// until the next start. Standing up, a folded leg is beyond that range, and the attitude is what
/// the accelerometer of a robot that may still move shows: beyond the tilt it is damped meanwhile.
enum class GuardMode { kStandUp, kWalk };

/// The last word on every command: what is not finite, or comes from a robot that has tipped over,
/// becomes damping; torques stay within the motors', joints within their limits.
class OutputGuard {
 public:
  /// @param robot borrowed. @param standing_rad its standing pose.
  OutputGuard(const SafetyParams& params, const core::RobotDescription& robot,
              const LegArray<Vec3>& standing_rad);

  [[nodiscard]] JointCommand Check(const JointCommand& command, const RobotState& state,
                                   GuardMode mode, Counters& counters) noexcept;
  [[nodiscard]] JointCommand Damping() const noexcept;

  void set_params(const SafetyParams& params) noexcept;

 private:
  struct JointRange {
    LegArray<Vec3> low_rad = ZeroPerLeg(), high_rad = ZeroPerLeg();
  };
  [[nodiscard]] static int TurnBackAtLimits(const JointRange& range, const SafetyParams& params,
                                            const RobotState& state,
                                            JointCommand& command) noexcept;

  SafetyParams params_;
  const core::RobotDescription& robot_;
  LegArray<Vec3> effort_Nm_, standing_rad_;
  JointRange limits_, working_;
  bool stopped_ = false, tilted_ = false;
};

[[nodiscard]] bool IsFinite(const JointCommand& command) noexcept;
[[nodiscard]] bool IsFinite(const ForcePlan& plan) noexcept;

/// What to push with when there is no usable plan: the weight shared by the feet that stand, the
/// body where the operator wants it.
[[nodiscard]] ForcePlan StandInPlan(double weight_N, const LegArray<bool>& contact,
                                    const BodyReference& reference, double stage_s) noexcept;

}  // namespace scoria::controller
