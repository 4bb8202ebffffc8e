// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/fall_clues.h"

#include <algorithm>
#include <cmath>

#include "analysis/field/leg_odometry.h"
#include "core/math/so3.h"
#include "core/robot/whole_body.h"
#include "logs/quality/leg_load.h"

namespace scoria::analysis {
namespace {

/// Of the trunk's origin over the ground under the lowest foot.
double HeightOverFeet(const core::RobotDescription& robot, const logs::Array12& q_rad,
                      const Mat3& R_WB) {
  const LegArray<Vec3> q = Unflatten(q_rad);
  double height_m = 0.0;
  for (const Leg leg : kLegs) {
    const core::LegDescription& description = robot.legs[leg];
    const Vec3 p_BF = core::CalcLegKinematics(description, q[leg]).p_BF;
    height_m = std::max(height_m, description.foot_radius_m - (R_WB * p_BF).z());
  }
  return height_m;
}

}  // namespace

/// Vertical force of the ground on all feet.
std::optional<double> FallClues::FeetForce(const logs::Row& row, const Mat3& R_WB) const {
  if (row.contacts && row.contacts->f_F_W_N) {
    const logs::Array12& f = *row.contacts->f_F_W_N;
    return f[2] + f[5] + f[8] + f[11];
  }
  if (!row.measured || !row.measured->q_rad || !row.measured->tau_Nm) return std::nullopt;
  logs::Tick tick;
  tick.q = Unflatten(*row.measured->q_rad);
  tick.tau = Unflatten(*row.measured->tau_Nm);
  const std::optional<Vec3> f_B = logs::CalcForceOfFeet(*robot_, tick);
  return f_B ? std::optional((R_WB * *f_B).z()) : std::nullopt;
}

FallSample FallClues::Update(const logs::Row& row, double dt_s) {
  FallSample sample{.dt_s = dt_s};
  const std::optional<Mat3> R_WB = AttitudeOf(row, robot_);
  if (!R_WB) return sample;
  sample.tilt_rad = BelievedTilt(row, *R_WB, dt_s);
  if (robot_ == nullptr || !row.measured || !row.measured->q_rad) return sample;
  sample.height_m = HeightOverFeet(*robot_, *row.measured->q_rad, *R_WB);
  const std::optional<double> feet_N = FeetForce(row, *R_WB);
  if (!feet_N) return sample;
  double all_N = mass_kg_ * gravity_mps2_;
  if (row.measured->a_WS_S_mps2) {
    const logs::Array3& a = *row.measured->a_WS_S_mps2;
    all_N = mass_kg_ * (*R_WB * (robot_->R_BS * Vec3(a[0], a[1], a[2]))).z();
  }
  const double share = std::min(1.0, dt_s / kLoad_s), now_N = all_N - *feet_N;
  load_N_ = load_N_ ? *load_N_ + share * (now_N - *load_N_) : now_N;
  const bool by_torques = !row.contacts || !row.contacts->f_F_W_N;
  const std::optional<double> load_N = by_torques ? WithoutUsual(*load_N_, dt_s) : load_N_;
  const bool low = *sample.height_m < kLow * robot_->config.nominal_height_m;
  if (low) sample.trunk_force_N = load_N;
  return sample;
}

double FallClues::UnexplainedTurn(const logs::Row& row, const Mat3& R_WB, double dt_s) const {
  const std::optional<Vec3> w_WB_B = RateOf(row, robot_);
  if (!last_R_WB_ || !w_WB_B) return HUGE_VAL;
  const Mat3 R_expected = *last_R_WB_ * core::ExpSo3(dt_s * *w_WB_B);
  return core::LogSo3(R_expected.transpose() * R_WB).norm();
}

double FallClues::BelievedTilt(const logs::Row& row, const Mat3& R_WB, double dt_s) {
  const double tilt_rad = std::acos(std::clamp(R_WB(2, 2), -1.0, 1.0));
  const bool known = !tilts_.empty() && row.time_s - tilts_.front().time_s >= kTilt_s;
  tilts_.push_back({row.time_s, tilt_rad, UnexplainedTurn(row, R_WB, dt_s)});
  last_R_WB_ = R_WB;
  while (tilts_.size() > 2 && row.time_s - tilts_[1].time_s >= kTilt_s) tilts_.pop_front();
  if (!known) return 0.0;  // of a first moment nothing is told
  double least_rad = tilt_rad, unexplained_rad = 0.0;
  for (std::size_t k = 1; k < tilts_.size(); ++k) unexplained_rad += tilts_[k].unexplained_rad;
  for (const Tilt& tilt : tilts_) least_rad = std::min(least_rad, tilt.tilt_rad);
  return unexplained_rad < kAgrees_rad ? tilt_rad : least_rad;
}

/// Nothing until the usual load is known.
std::optional<double> FallClues::WithoutUsual(double load_N, double dt_s) {
  constexpr double kFirst_s = 1.0;
  seen_s_ = std::min(kUsual_s, seen_s_ + dt_s);
  if (seen_s_ > 0.0) usual_N_ += dt_s / seen_s_ * (load_N - usual_N_);
  return seen_s_ >= kFirst_s ? std::optional(load_N - usual_N_) : std::nullopt;
}

}  // namespace scoria::analysis
