// SPDX-License-Identifier: BSD-3-Clause
#include "controller/adaptation/wrench_balance.h"

#include <algorithm>
#include <cmath>

#include "core/math/low_pass.h"
#include "core/math/so3.h"

namespace scoria::controller {
namespace {

bool IsFinite(const AdapterInput& in) noexcept {
  bool finite = in.state.R_WB.allFinite() && in.state.w_WB.allFinite() && in.z.a_WS_S.allFinite() &&
                in.z.w_WS_S.allFinite();
  for (const Leg leg : kLegs) {
    finite = finite && in.state.q[leg].allFinite() && in.state.qd[leg].allFinite() &&
             in.z.tau_Nm[leg].allFinite() && in.contact.f_F_W[leg].allFinite();
  }
  return finite;
}

constexpr int kWrench = 0, kForce = 6, kTurn = 9, kFeet = 18, kAtStop = 30;  // where in Prompt

}  // namespace

WrenchBalance::WrenchBalance(const WrenchBalanceParams& params,
                             const core::RobotDescription& robot) noexcept
    : params_(params), robot_(robot), model_(robot, params.gravity_mps2) {
  model_.Calc({}, wb_);
}

void WrenchBalance::Restart() noexcept {
  started_ = false;
  sum_ = {};
}

WrenchBalance::Signals WrenchBalance::CalcSignals(const AdapterInput& in) noexcept {
  RobotState state = in.state;
  state.p_WB = state.v_WB = Vec3::Zero();
  model_.Calc(state, wb_);
  const Vec3 before = started_ ? w_WS_S_ : in.z.w_WS_S;
  const double share =
      core::LowPassShare(core::TimeConstant_s(params_.observer.gyro_cutoff_Hz), in.dt_s);
  w_WS_S_ = before + share * (in.z.w_WS_S - before);
  const Vec3 w_B = robot_.R_BS * w_WS_S_;
  const Vec3 alpha_B = robot_.R_BS * (w_WS_S_ - before) / in.dt_s;
  const Mat3 W = core::Skew(w_B);
  const Mat3 A = core::Skew(alpha_B) + W * W;  // a point p moves with s + A p
  const Vec3 s_B = robot_.R_BS * in.z.a_WS_S - A * robot_.p_BS;
  const Mat3& R_WB = state.R_WB;
  Vec6 a_B;
  a_B << R_WB * s_B - Vec3(0.0, 0.0, params_.gravity_mps2), R_WB * alpha_B;
  const Vec6 wrench_W = wb_.H_BB * a_B + wb_.h_B;
  Vec6 speed_W = Vec6::Zero();
  Signals now;
  for (const Leg leg : kLegs) {
    if (started_) speed_W += wb_.H_Bl[leg] * ((state.qd[leg] - qd_[leg]) / in.dt_s);
    qd_[leg] = state.qd[leg];
    now.prompt.segment<3>(kFeet + 3 * static_cast<Eigen::Index>(leg)) =
        R_WB.transpose() * wb_.p_BF_W[leg];
  }
  now.prompt.segment<3>(kWrench) = R_WB.transpose() * wrench_W.head<3>();
  now.prompt.segment<3>(kWrench + 3) = R_WB.transpose() * wrench_W.tail<3>();
  now.prompt.segment<3>(kForce) = s_B;
  now.prompt.segment<9>(kTurn) = A.reshaped();
  now.prompt[kAtStop] = IsAtStop(state) ? 1.0 : 0.0;
  now.speed << R_WB.transpose() * speed_W.head<3>(), R_WB.transpose() * speed_W.tail<3>();
  return now;
}

/// As late as MomentumObserver's forces.
void WrenchBalance::Filter(const Signals& now, double dt_s) noexcept {
  if (!started_) {
    signals_.Clear();
    prompt_.Settle(now.prompt);
    speed_.Settle(Vec6::Zero());
  }
  signals_.Next() = now;
  const ObserverParams& observer = params_.observer;
  const Lag lag =
      CalcLag(observer.torque_delay_s, observer.velocity_bandwidth_Hz, observer.cutoff_Hz, dt_s);
  const Signals& then = signals_.Ago(lag.steps);
  prompt_.Update(then.prompt, Prompt::Zero(), lag);
  speed_.Update(Vec6::Zero(), then.speed, lag);
  started_ = true;
}

/// Follows the joints' friction. At the start there is none: the body controller's torques carry
/// the weight that the position hold before it left to friction.
void WrenchBalance::Slide(const RobotState& state) noexcept {
  if (params_.presliding_rad <= 0.0) return;
  for (const Leg leg : kLegs) {
    const Vec3 slid = slid_[leg] + (state.q[leg] - q_[leg]) / params_.presliding_rad;
    slid_[leg] = started_ ? Vec3(slid.cwiseMax(-1.0).cwiseMin(1.0)) : Vec3(Vec3::Zero());
    q_[leg] = state.q[leg];
  }
}

/// Foot force in W from friction that the observer does not know of.
Vec3 WrenchBalance::CalcStiction(Leg leg, const RobotState& state) const noexcept {
  if (params_.presliding_rad <= 0.0 || !params_.observer.coulomb_friction) return Vec3::Zero();
  const Vec3 known = (state.qd[leg] / params_.observer.coulomb_smooth_radps).array().tanh();
  const Vec3 t = robot_.config.motors.friction_Nm.cwiseProduct(slid_[leg] - known);
  return CalcFootForce(wb_.J_ll[leg], t, params_.observer.singular_below_m);
}

bool WrenchBalance::IsAtStop(const RobotState& state) const noexcept {
  constexpr double kNear_rad = 0.01;
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const core::JointDescription& joint = robot_.legs[leg].joints[static_cast<std::size_t>(j)];
      const double q = state.q[leg][j];
      if (q < joint.lower_rad + kNear_rad || q > joint.upper_rad - kNear_rad) return true;
    }
  }
  return false;
}

/// Normal of the ground in W. Feet on a diagonal are both down or both up when the robot stands or
/// trots, so that a diagonal lies along the ground.
Vec3 WrenchBalance::CalcGroundNormal_W() const noexcept {
  const LegArray<Vec3>& p = wb_.p_BF_W;
  const Vec3 n = (p[Leg::kFL] - p[Leg::kHR]).cross(p[Leg::kHL] - p[Leg::kFR]);
  const double length = n.norm();
  constexpr double kLeast_m2 = 0.01;  // feet nearly in line span no plane
  const double size_m = robot_.similarity.length;
  return length > kLeast_m2 * size_m * size_m ? Vec3(n / length) : Vec3(Vec3::UnitZ());
}

/// The observer's force acts at the foot sphere's centre F, the ground's where the sphere touches:
/// forces of the same joint torques, J_Fᵀ f_F = J_Kᵀ f_K.
Vec3 WrenchBalance::MoveToContact(Leg leg, const Vec3& f_F_W, const Vec3& p_FK_W) const noexcept {
  const Mat3& J = wb_.J_ll[leg];
  const Mat3 J_K = J - core::Skew(p_FK_W) * wb_.Jw_ll[leg];
  return CalcFootForce(J_K, J.transpose() * f_F_W, params_.observer.singular_below_m);
}

bool WrenchBalance::Add(const AdapterInput& in) noexcept {
  if (!(in.dt_s > 0.0) || !IsFinite(in)) return false;
  Slide(in.state);
  Filter(CalcSignals(in), in.dt_s);
  const Prompt& prompt = prompt_.out();
  Vec6 wrench = Vec6::Zero();
  bool stands = false;
  const Mat3 R_BW = in.state.R_WB.transpose();
  const Vec3 n_W = CalcGroundNormal_W();
  for (const Leg leg : kLegs) {
    const Vec3 p_FK_W = -robot_.legs[leg].foot_radius_m * n_W;
    const Vec3 f_F_W = in.contact.f_F_W[leg] + CalcStiction(leg, in.state);
    const Vec3 f_B = R_BW * MoveToContact(leg, f_F_W, p_FK_W);
    const Vec3 p_BF = prompt.segment<3>(kFeet + 3 * static_cast<Eigen::Index>(leg));
    wrench.head<3>() += f_B;
    wrench.tail<3>() += (p_BF + R_BW * p_FK_W).cross(f_B);
    stands = stands || in.contact.contact[leg];
  }
  const Vec3 s_B = prompt.segment<3>(kForce);
  const Mat3 A = prompt.segment<9>(kTurn).reshaped(3, 3);
  const double z = params_.payload_height_m;
  Mat63 Y;
  Y.topRows<3>() << s_B + z * A.col(2), A.col(0), A.col(1);
  Y.bottomRows<3>() << z * Vec3::UnitZ().cross(s_B), Vec3::UnitX().cross(s_B),
      Vec3::UnitY().cross(s_B);
  sum_.wrench += wrench;
  sum_.nominal += prompt.segment<6>(kWrench) + speed_.out();
  sum_.Y += Y;
  sum_.s_B += s_B;
  ++sum_.steps;
  sum_.steps_without_contact += stands ? 0 : 1;
  constexpr double kFaded = 0.02;  // of a stop in the forces, since these lag
  sum_.steps_at_stop += prompt[kAtStop] > kFaded ? 1 : 0;
  return true;
}

WrenchSample WrenchBalance::Take() noexcept {
  WrenchSample mean = sum_;
  const double n = std::max(1, sum_.steps);
  mean.wrench /= n;
  mean.nominal /= n;
  mean.Y /= n;
  mean.s_B /= n;
  sum_ = {};
  return mean;
}

}  // namespace scoria::controller
