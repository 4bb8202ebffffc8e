// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/world_shift.h"

#include "core/math/so3.h"

namespace scoria::core {

WorldShift WorldShift::Between(const RobotState& in_W, const RobotState& in_V) noexcept {
  WorldShift shift;
  shift.yaw_rad = RpyFromRotation(in_V.R_WB).z() - RpyFromRotation(in_W.R_WB).z();
  shift.p_VW = in_V.p_WB - RotationZ(shift.yaw_rad) * in_W.p_WB;
  return shift;
}

RobotState WorldShift::Apply(const RobotState& in_W) const noexcept {
  const Mat3 R_VW = RotationZ(yaw_rad);
  RobotState in_V = in_W;
  in_V.p_WB = R_VW * in_W.p_WB + p_VW;
  in_V.R_WB = R_VW * in_W.R_WB;
  in_V.v_WB = R_VW * in_W.v_WB;
  in_V.w_WB = R_VW * in_W.w_WB;
  return in_V;
}

}  // namespace scoria::core
