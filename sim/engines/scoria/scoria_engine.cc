// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/scoria/scoria_engine.h"

#include "core/math/so3.h"

namespace scoria::sim {

StepResult ScoriaEngine::Step(const StepInput& in, std::span<ContactPoint> contacts) {
  const double dt = in.dt_s;
  const Vec18 v = solver_.Solve(in, contacts);
  StepResult result{in.wb.state, solver_.JointImpulses(), solver_.iterations()};
  RobotState& state = result.state;
  state.v_WB = v.head<3>();
  state.w_WB = v.segment<3>(3);
  state.p_WB += dt * state.v_WB;
  state.R_WB = Quat(core::ExpSo3(dt * state.w_WB) * state.R_WB).normalized().toRotationMatrix();
  for (const Leg leg : kLegs) {
    state.qd[leg] = v.segment<3>(6 + kJointsPerLeg * static_cast<int>(leg));
    state.q[leg] += dt * state.qd[leg];
    result.joint_impulse[leg] -=
        dt * robot_.config.motors.damping_Nms_per_rad.cwiseProduct(state.qd[leg]);
  }
  return result;
}

}  // namespace scoria::sim
