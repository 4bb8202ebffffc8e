// SPDX-License-Identifier: BSD-3-Clause
#include "controller/model/momentum_observer.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "core/math/low_pass.h"

namespace scoria::controller {

Vec3 CalcFootForce(const Mat3& J, const Vec3& t, double singular_below_m) noexcept {
  const Mat3 A = J * J.transpose();
  Eigen::SelfAdjointEigenSolver<Mat3> eigen;
  eigen.computeDirect(A, Eigen::EigenvaluesOnly);
  const double least2 = std::max(eigen.eigenvalues()[0], 0.0);
  const double limit2 = singular_below_m * singular_below_m;
  if (least2 >= limit2) return J.transpose().inverse() * t;
  // Continuous at the limit; at least2 = 0 the damping equals the limit itself.
  const Mat3 damped = A + (limit2 - least2) * Mat3::Identity();
  return damped.inverse() * (J * t);
}

LegArray<Vec3> CalcQuasiStaticForces(const core::WholeBody& wb_at_rest,
                                     const LegArray<Vec3>& tau_Nm,
                                     double singular_below_m) noexcept {
  LegArray<Vec3> f_F_W = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    f_F_W[leg] =
        CalcFootForce(wb_at_rest.J_ll[leg], wb_at_rest.h_l[leg] - tau_Nm[leg], singular_below_m);
  }
  return f_F_W;
}

Vec6 MomentumObserver::CalcTrunkAcceleration(const ObserverInput& in) noexcept {
  const Mat3& R_WB = in.wb.state.R_WB;
  const Mat3 R_WS = R_WB * robot_.R_BS;
  const Vec3 before = started_ ? w_WS_S_ : in.z.w_WS_S;
  const double share = core::LowPassShare(core::TimeConstant_s(params_.gyro_cutoff_Hz), in.dt_s);
  w_WS_S_ = before + share * (in.z.w_WS_S - before);
  // The change of w in S: R_WS turns with w, and w × w = 0.
  const Vec3 alpha_W = R_WS * (w_WS_S_ - before) / in.dt_s;
  const Vec3 w_W = R_WS * w_WS_S_;
  const Vec3 r = R_WB * robot_.p_BS;
  const Vec3 a_tangential = alpha_W.cross(r);
  const Vec3 v_tangential = w_W.cross(r);
  const Vec3 a_centripetal = w_W.cross(v_tangential);
  const Vec3 a_WS_W = R_WS * in.z.a_WS_S + g_W_;
  Vec6 a_B;
  a_B.head<3>() = a_WS_W - a_tangential - a_centripetal;
  a_B.tail<3>() = alpha_W;
  return a_B;
}

Vec3 MomentumObserver::CalcFriction(const Vec3& qd) const noexcept {
  const core::MotorParams& motors = robot_.config.motors;
  Vec3 t = Vec3::Zero();
  if (params_.viscous_friction) t += motors.damping_Nms_per_rad.cwiseProduct(qd);
  if (params_.coulomb_friction) {
    t += motors.friction_Nm.cwiseProduct(
        (qd / params_.coulomb_smooth_radps).array().tanh().matrix());
  }
  return t;
}

void MomentumObserver::UpdateLeg(Leg leg, const Sample& then, const Vec3& tau_Nm,
                                 const Lag& lag) noexcept {
  const Vec3 prompt = then.t_prompt[leg] - tau_Nm;
  // What is not finite must not stay in the filters for good.
  if (!prompt.allFinite() || !then.t_speed[leg].allFinite() || !then.J[leg].allFinite()) return;
  const Vec3& t_f = t_f_[leg].Update(prompt, then.t_speed[leg], lag);
  f_F_W_[leg] = CalcFootForce(then.J[leg], t_f, params_.singular_below_m);
}

const LegArray<Vec3>& MomentumObserver::Update(const ObserverInput& in) noexcept {
  if (!in.z.a_WS_S.allFinite() || !in.z.w_WS_S.allFinite()) return f_F_W_;
  a_B_ = CalcTrunkAcceleration(in);
  Sample& now = samples_.Next();
  for (const Leg leg : kLegs) {
    const Vec3& qd = in.z.qd[leg];
    const Vec3 qdd = started_ ? Vec3((qd - qd_[leg]) / in.dt_s) : Vec3(Vec3::Zero());
    now.t_prompt[leg] = in.wb.H_Bl[leg].transpose() * a_B_ + in.wb.h_l[leg];
    now.t_speed[leg] = in.wb.H_ll[leg] * qdd + CalcFriction(qd);
    now.J[leg] = in.wb.J_ll[leg];
    qd_[leg] = qd;
  }
  const Lag lag = started_ ? CalcLag(params_.torque_delay_s, params_.velocity_bandwidth_Hz,
                                     params_.cutoff_Hz, in.dt_s)
                           : Lag{};
  const Sample& then = samples_.Ago(lag.steps);
  for (const Leg leg : kLegs) UpdateLeg(leg, then, in.z.tau_Nm[leg], lag);
  started_ = true;
  return f_F_W_;
}

}  // namespace scoria::controller
