// SPDX-License-Identifier: BSD-3-Clause
#include "controller/adaptation/kf_plus.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>

namespace scoria::controller {

void Tare::Add(const WrenchSample& sample, double dt_s) noexcept {
  if (done()) return;
  time_s_ += dt_s;
  const double share = std::min(1.0, dt_s / time_s_);  // running mean
  error_ += share * (sample.wrench - sample.nominal - error_);
  load_N_ += share * (sample.wrench.z() - load_N_);
}

Vec6 Tare::Calc(const WrenchSample& sample) const noexcept {
  if (!(load_N_ > 0.0)) return error_;
  const double load = std::max(0.0, sample.wrench.z() / load_N_);
  return (1.0 + params_.gain_share * (load - 1.0)) * error_;
}

void StepDetector::Reset() noexcept { smooth_ = up_s_ = down_s_ = Vec3::Zero(); }

bool StepDetector::Update(const Vec3& error, double dt_s) noexcept {
  const Vec3 drift(params_.drift_kg, params_.drift_kgm, params_.drift_kgm);
  smooth_ += std::min(1.0, dt_s / (params_.smooth_s + dt_s)) * (error - smooth_);
  rest_s_ = std::max(0.0, rest_s_ - dt_s);
  if (rest_s_ > 0.0) return false;
  const Vec3 e = smooth_.cwiseQuotient(drift);
  up_s_ = (up_s_ + dt_s * (e - Vec3::Ones())).cwiseMax(0.0);
  down_s_ = (down_s_ + dt_s * (-e - Vec3::Ones())).cwiseMax(0.0);
  if (std::max(up_s_.maxCoeff(), down_s_.maxCoeff()) < params_.threshold_s) return false;
  Reset();
  rest_s_ = params_.refill_s;
  return true;
}

AdaptationKfPlus::AdaptationKfPlus(const KfPlusParams& params, const core::RobotDescription& robot,
                                   double gravity_mps2, const ObserverParams& observer) noexcept
    : params_(params),
      balance_({gravity_mps2, params.update_gate.payload_height_m, params.presliding_rad, observer},
               robot),
      tare_(params.tare),
      detector_(params.step),
      update_gate_(params.update_gate, robot) {
  filter_.P = OpenCovariance();
  out_ = update_gate_.Update(filter_.pi, filter_.P, balance_.nominal(), 0.0);
  out_.tared = tare_.done();
}

Mat3 AdaptationKfPlus::OpenCovariance() const noexcept {
  const Vec3 sigma(params_.initial_kg, params_.initial_kgm, params_.initial_kgm);
  return sigma.cwiseAbs2().asDiagonal();
}

void AdaptationKfPlus::Correct(const WrenchSample& sample, double dt_s) noexcept {
  const Vec6 excess = sample.wrench - sample.nominal - tare_.Calc(sample);
  Vec6 R;
  R << Vec3::Constant(params_.force_N * params_.force_N),
      Vec3::Constant(params_.moment_Nm * params_.moment_Nm);
  const Mat63 weighted = R.cwiseInverse().asDiagonal() * sample.Y;
  Mat3 information = sample.Y.transpose() * weighted;
  // In free fall nothing weighs: what then divides by zero may count as no error.
  information += OpenCovariance().inverse();
  const Vec6 innovation = excess - sample.Y * filter_.pi;
  const Vec3 error = information.ldlt().solve(weighted.transpose() * innovation);
  if (detector_.Update(error, dt_s)) filter_.P = OpenCovariance();
  // Huber: beyond the limit the noise grows with the error, so that its pull stays constant. What
  // the filter itself is not sure of widens the limit: right after a change nothing is an outlier.
  const Vec6 spread = (sample.Y * filter_.P * sample.Y.transpose()).diagonal() + R;
  const Vec6 limit = params_.huber * spread.cwiseSqrt();
  R = R.cwiseProduct(innovation.cwiseAbs().cwiseQuotient(limit).cwiseMax(1.0));
  const Vec3 walk(params_.walk_kg_per_sqrts, params_.walk_kgm_per_sqrts,
                  params_.walk_kgm_per_sqrts);
  filter_.Update(sample.Y, excess, dt_s * walk.cwiseAbs2(), R);
  filter_.pi = update_gate_.Clamp(filter_.pi);
}

/// What is carried already is no tare.
void AdaptationKfPlus::Continue(const core::ModelParameters& in_use) noexcept {
  filter_.pi = update_gate_.Continue(in_use);
  tare_ = Tare({.enabled = false});
  out_.parameters = in_use;
}

const Adaptation& AdaptationKfPlus::Update(const AdapterInput& in) noexcept {
  out_.changed = false;
  if (!in.at_work) {
    balance_.Restart();
    detector_.Reset();
    at_work_s_ = since_s_ = 0.0;
    return out_;
  }
  if (!balance_.Add(in)) return out_;
  at_work_s_ += in.dt_s;
  since_s_ += in.dt_s;
  if (since_s_ < 1.0 / params_.rate_Hz - 0.5 * in.dt_s) return out_;
  const double dt_s = since_s_;
  since_s_ = 0.0;
  const WrenchSample sample = balance_.Take();
  // Without a foot on the ground someone carries the robot, or it flies; a joint stop takes load.
  const bool weighs = at_work_s_ > params_.start_s && sample.steps_without_contact == 0 &&
                      sample.steps_at_stop == 0;
  if (weighs && !tare_.done()) {
    tare_.Add(sample, dt_s);
  } else if (weighs) {
    Correct(sample, dt_s);
  }
  out_ = update_gate_.Update(filter_.pi, filter_.P, balance_.nominal(), dt_s);
  out_.tared = tare_.done();
  return out_;
}

}  // namespace scoria::controller
