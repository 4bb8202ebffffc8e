// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/config/field.h"
#include "core/robot/description.h"
#include "core/robot/state.h"

namespace scoria::controller {

struct StandUpParams {
  double duration_s = 1.5;
  double hold_s = 0.3;
  double kp_Nm_per_rad = 100.0, kd_Nms_per_rad = 2.5;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("duration_s", duration_s, {.min = 0.1, .max = 20.0, .scale = core::dimension::kTime});
    a.Field("hold_s", hold_s,
            {.min = 0.0,
             .max = 20.0,
             .doc = "rest on the joint controller after standing up",
             .scale = core::dimension::kTime});
    a.Field("kp_Nm_per_rad", kp_Nm_per_rad,
            {.min = 1.0, .max = 1e5, .scale = core::dimension::kTorque});
    a.Field("kd_Nms_per_rad", kd_Nms_per_rad,
            {.min = 0.0, .max = 1e4, .scale = core::dimension::kJointDamping});
  }
  bool operator==(const StandUpParams&) const = default;
};

/// Time from the start of a controller to its taking charge, unless it has to wait for rest.
[[nodiscard]] inline double CalcStandUpTime(const StandUpParams& params, bool lying) noexcept {
  return (lying ? params.duration_s : 0.0) + params.hold_s;
}

/// Joint angles at which the feet stand below the neutral footholds, `height_m` the trunk's origin
/// over the feet's centres.
[[nodiscard]] LegArray<Vec3> StandingPose(const core::RobotDescription& robot, double height_m);

/// From whatever pose the robot lies in to the standing pose, or holds the pose that it was put
/// down in: smooth joint interpolation under joint PD.
class StandUp {
 public:
  /// @param goal without one it holds.
  StandUp(const StandUpParams& params, const std::optional<LegArray<Vec3>>& goal) noexcept
      : params_(params), goal_(goal) {}

  /// @param q joint angles now. @param time_s since the controller started.
  [[nodiscard]] JointCommand Update(const LegArray<Vec3>& q, double time_s) noexcept;
  [[nodiscard]] bool IsDone(double time_s) const noexcept {
    return time_s >= CalcStandUpTime(params_, goal_.has_value());
  }

 private:
  StandUpParams params_;
  std::optional<LegArray<Vec3>> goal_;
  LegArray<Vec3> start_ = ZeroPerLeg();
  bool started_ = false;
};

}  // namespace scoria::controller
