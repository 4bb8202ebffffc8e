// SPDX-License-Identifier: BSD-3-Clause
#include "controller/adaptation/kf.h"

#include <cmath>

#include <Eigen/Cholesky>

#include "core/math/so3.h"

namespace scoria::controller {

void MassKalmanFilter::Update(const Mat63& Phi, const Vec6& z, const Vec3& Q,
                              const Vec6& R) noexcept {
  P += Q.asDiagonal();
  Mat6 S = Phi * P * Phi.transpose();
  S += R.asDiagonal();
  const Mat63 gain = S.ldlt().solve(Phi * P);  // Kᵀ, as S and P are symmetric
  pi += gain.transpose() * (z - Phi * pi);
  const Mat3 left = Mat3::Identity() - gain.transpose() * Phi;
  const Mat3 next = left * P * left.transpose() + gain.transpose() * R.asDiagonal() * gain;
  P = 0.5 * (next + next.transpose());
}

AdaptationKf::AdaptationKf(const AdaptationKfParams& params, const core::RobotDescription& robot,
                           double gravity_mps2) noexcept
    : params_(params),
      robot_(robot),
      gravity_mps2_(gravity_mps2),
      model_(robot, gravity_mps2),
      update_gate_(params.update_gate, robot) {
  model_.Calc({}, wb_);
  const Vec3 c = wb_.p_WC - wb_.state.p_WB;
  filter_.pi = wb_.mass_kg * Vec3(1.0, c.x(), c.y());
  const Vec3 sigma(params.initial_kg, params.initial_kgm, params.initial_kgm);
  filter_.P = sigma.cwiseAbs2().asDiagonal();
  out_ = update_gate_.Update(Vec3::Zero(), filter_.P, wb_, 0.0);
  out_.tared = true;
}

/// tau acts from trunk to foot, so the ground's force on the robot is opposite.
Vec3 AdaptationKf::CalcFootForce_W(Leg leg, const AdapterInput& in) const noexcept {
  if (params_.leg_forces == LegForces::kObserver) return in.contact.f_F_W[leg];
  Vec3 tau_Nm = in.z.tau_Nm[leg];
  if (params_.leg_forces == LegForces::kWeight) {
    // The linear rows of H_Bl are the leg's mass times the Jacobian of its centre.
    tau_Nm -= gravity_mps2_ * wb_.H_Bl[leg].row(2).transpose();
  }
  return -wb_.J_ll[leg].transpose().inverse() * tau_Nm;
}

void AdaptationKf::Correct(const AdapterInput& in, double dt_s) noexcept {
  Vec6 z = Vec6::Zero();
  const Mat3 R_HW = core::RotationZ(-core::RpyFromRotation(in.state.R_WB).z());
  for (const Leg leg : kLegs) {
    const Vec3 F = R_HW * CalcFootForce_W(leg, in);
    const Vec3 r = R_HW * wb_.p_BF_W[leg];
    z.head<3>() += F;
    z.tail<3>() += r.cross(F);
  }
  Mat63 Phi = Mat63::Zero();
  Phi.block<3, 1>(0, 0) = params_.acceleration
                              ? Vec3(R_HW * in.state.R_WB * robot_.R_BS * in.z.a_WS_S)
                              : Vec3(0.0, 0.0, gravity_mps2_);
  Phi(4, 1) = -gravity_mps2_;
  Phi(3, 2) = gravity_mps2_;
  if (!z.allFinite() || !Phi.allFinite()) return;
  const Vec3 walk(params_.walk_kg_per_sqrts, params_.walk_kgm_per_sqrts,
                  params_.walk_kgm_per_sqrts);
  Vec6 R;
  R << Vec3::Constant(params_.force_N * params_.force_N),
      Vec3::Constant(params_.moment_Nm * params_.moment_Nm);
  filter_.Update(Phi, z, dt_s * walk.cwiseAbs2(), R);
}

void AdaptationKf::Continue(const core::ModelParameters& in_use) noexcept {
  filter_.pi += update_gate_.Continue(in_use);
  out_.parameters = in_use;
}

const Adaptation& AdaptationKf::Update(const AdapterInput& in) noexcept {
  out_.changed = false;
  if (!in.at_work || !(in.dt_s > 0.0)) return out_;
  since_s_ += in.dt_s;
  if (since_s_ < 1.0 / params_.rate_Hz - 0.5 * in.dt_s) return out_;
  RobotState state = in.state;
  state.p_WB = state.v_WB = Vec3::Zero();
  model_.Calc(state, wb_);
  const double dt_s = since_s_;
  since_s_ = 0.0;
  if (!wb_.h_B.allFinite()) return out_;
  Correct(in, dt_s);
  const Vec3 c = wb_.state.R_WB.transpose() * wb_.p_WC;
  const Vec3 nominal = wb_.mass_kg * Vec3(1.0, c.x(), c.y());
  out_ = update_gate_.Update(filter_.pi - nominal, filter_.P, wb_, dt_s);
  out_.tared = true;
  return out_;
}

}  // namespace scoria::controller
