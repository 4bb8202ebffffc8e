// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/motion.h"

#include "controller/model/momentum_observer.h"

namespace scoria::test {

SensorFrame Sense(const core::RobotDescription& robot, const core::WholeBody& wb, const Motion& m) {
  SensorFrame z;
  z.q = m.state.q;
  z.qd = m.state.qd;
  const Mat3 R_WS = m.state.R_WB * robot.R_BS;
  const Vec3& w = m.state.w_WB;
  const Vec3 r = m.state.R_WB * robot.p_BS;
  const Vec3 v_lever = w.cross(r);
  const Vec3 a = m.vd_WB + m.wd_WB.cross(r) + w.cross(v_lever) + Vec3(0.0, 0.0, kGravity_mps2);
  z.a_WS_S = R_WS.transpose() * a;
  z.w_WS_S = R_WS.transpose() * w;
  Vec6 a_B;
  a_B.head<3>() = m.vd_WB;
  a_B.tail<3>() = m.wd_WB;
  const core::MotorParams& motors = robot.config.motors;
  const double smooth_radps = controller::ObserverParams{}.coulomb_smooth_radps;
  for (const Leg leg : kLegs) {
    const Vec3 sign = (m.state.qd[leg] / smooth_radps).array().tanh();
    const Vec3 friction = motors.damping_Nms_per_rad.cwiseProduct(m.state.qd[leg]) +
                          motors.friction_Nm.cwiseProduct(sign);
    z.tau_Nm[leg] = wb.H_Bl[leg].transpose() * a_B + wb.H_ll[leg] * m.qdd[leg] + wb.h_l[leg] +
                    friction - wb.J_ll[leg].transpose() * m.f_F_W[leg];
  }
  return z;
}

}  // namespace scoria::test
