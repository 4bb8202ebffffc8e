// SPDX-License-Identifier: BSD-3-Clause
#include "controller/adaptation/rls.h"

#include <cmath>

#include <Eigen/Cholesky>

namespace scoria::controller {

void ForgettingLeastSquares::Update(const Mat63& Phi, const Vec6& z, const Vec6& R, double forget,
                                    const Vec3& floor) noexcept {
  const Mat63 weighted = R.cwiseInverse().asDiagonal() * Phi;
  information *= forget;
  information.diagonal() = information.diagonal().cwiseMax(floor);
  information += Phi.transpose() * weighted;
  pi += information.ldlt().solve(weighted.transpose() * (z - Phi * pi));
}

Mat3 ForgettingLeastSquares::P() const noexcept {
  return information.ldlt().solve(Mat3::Identity());
}

RecursiveLeastSquares::RecursiveLeastSquares(const RlsParams& params,
                                             const core::RobotDescription& robot,
                                             double gravity_mps2,
                                             const ObserverParams& observer) noexcept
    : params_(params),
      balance_({gravity_mps2, params.update_gate.payload_height_m, 0.0, observer}, robot),
      update_gate_(params.update_gate, robot) {
  const core::WholeBody& wb = balance_.nominal();
  const Vec3 c = wb.p_WC - wb.state.p_WB;
  filter_.pi = wb.mass_kg * Vec3(1.0, c.x(), c.y());
  const Vec3 sigma(params.initial_kg, params.initial_kgm, params.initial_kgm);
  filter_.information = sigma.cwiseAbs2().cwiseInverse().asDiagonal();
  out_ = update_gate_.Update(Vec3::Zero(), filter_.P(), wb, 0.0);
  out_.tared = true;
}

void RecursiveLeastSquares::Correct(const WrenchSample& sample, double dt_s) noexcept {
  const core::WholeBody& wb = balance_.nominal();
  const Vec3 c = wb.state.R_WB.transpose() * (wb.p_WC - wb.state.p_WB);
  Mat63 Phi = Mat63::Zero();
  Phi.block<3, 1>(0, 0) = sample.s_B;
  Phi.block<3, 1>(3, 0) = c.z() * Vec3::UnitZ().cross(sample.s_B);
  Phi.block<3, 1>(3, 1) = Vec3::UnitX().cross(sample.s_B);
  Phi.block<3, 1>(3, 2) = Vec3::UnitY().cross(sample.s_B);
  const Vec3 sigma(params_.initial_kg, params_.initial_kgm, params_.initial_kgm);
  Vec6 R;
  R << Vec3::Constant(params_.force_N * params_.force_N),
      Vec3::Constant(params_.moment_Nm * params_.moment_Nm);
  filter_.Update(Phi, sample.wrench, R, std::exp(-dt_s / params_.memory_s),
                 sigma.cwiseAbs2().cwiseInverse());
}

void RecursiveLeastSquares::Continue(const core::ModelParameters& in_use) noexcept {
  filter_.pi += update_gate_.Continue(in_use);
  out_.parameters = in_use;
}

const Adaptation& RecursiveLeastSquares::Update(const AdapterInput& in) noexcept {
  out_.changed = false;
  if (!in.at_work) {
    balance_.Restart();
    return out_;
  }
  if (!balance_.Add(in)) return out_;
  since_s_ += in.dt_s;
  if (since_s_ < 1.0 / params_.rate_Hz - 0.5 * in.dt_s) return out_;
  const double dt_s = since_s_;
  since_s_ = 0.0;
  const WrenchSample sample = balance_.Take();
  if (sample.steps_without_contact == 0) Correct(sample, dt_s);
  const core::WholeBody& wb = balance_.nominal();
  const Vec3 c = wb.state.R_WB.transpose() * (wb.p_WC - wb.state.p_WB);
  const Vec3 nominal = wb.mass_kg * Vec3(1.0, c.x(), c.y());
  out_ = update_gate_.Update(filter_.pi - nominal, filter_.P(), wb, dt_s);
  out_.tared = true;
  return out_;
}

}  // namespace scoria::controller
