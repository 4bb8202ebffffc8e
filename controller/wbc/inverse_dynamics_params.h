// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"

namespace scoria::controller {

struct InverseDynamicsParams {
  static constexpr const char* kType = "inverse_dynamics";
  double stance_kp_Nm_per_rad = 20.0, stance_kd_Nms_per_rad = 2.0;
  double swing_kp_Nm_per_rad = 60.0, swing_kd_Nms_per_rad = 2.0;
  double max_joint_error_rad = 0.3;
  double target_lead_s = 0.01;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("stance_kp_Nm_per_rad", stance_kp_Nm_per_rad,
            {.min = 0.0, .max = 1e3, .scale = core::dimension::kTorque});
    a.Field("stance_kd_Nms_per_rad", stance_kd_Nms_per_rad,
            {.min = 0.0, .max = 100.0, .scale = core::dimension::kJointDamping});
    a.Field("swing_kp_Nm_per_rad", swing_kp_Nm_per_rad,
            {.min = 0.0, .max = 1e3, .scale = core::dimension::kTorque});
    a.Field("swing_kd_Nms_per_rad", swing_kd_Nms_per_rad,
            {.min = 0.0, .max = 100.0, .scale = core::dimension::kJointDamping});
    a.Field("max_joint_error_rad", max_joint_error_rad,
            {.min = 0.01, .max = 3.0, .doc = "clip of the joint controller's position error"});
    a.Field("target_lead_s", target_lead_s,
            {.min = 0.0,
             .max = 0.2,
             .doc = "how far ahead on the MPC's predicted motion the body target lies",
             .scale = core::dimension::kTime});
  }
  bool operator==(const InverseDynamicsParams&) const = default;
};

}  // namespace scoria::controller
