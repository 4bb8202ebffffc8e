// SPDX-License-Identifier: BSD-3-Clause
#include "controller/reference/reference_planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/LU>

#include "core/math/low_pass.h"
#include "core/math/so3.h"

namespace scoria::controller {

double TimeConstantOfTickGain_s(double gain) {
  constexpr double kTick_s = 0.01;
  return gain < 1.0 ? -kTick_s / std::log1p(-std::max(gain, 0.0)) : 0.0;
}
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

double Towards(double from, double to, double max_step) noexcept {
  return from + std::clamp(to - from, -max_step, max_step);
}

}  // namespace

void ReferencePlanner::ObserveFeet(const core::WholeBody& wb, const LegArray<bool>& contact,
                                   double foot_radius_m, double dt_s) noexcept {
  for (const Leg leg : kLegs) {
    if (started_ && !contact[leg]) continue;
    foothold_W_[leg] = wb.p_WF[leg] - Vec3(0.0, 0.0, foot_radius_m);
  }
  FitPlane(wb.state.p_WB, started_ ? core::LowPassShare(params_.plane_slope_s, dt_s) : 1.0,
           started_ ? core::LowPassShare(params_.plane_height_s, dt_s) : 1.0);
}

void ReferencePlanner::ObserveGround(const core::WholeBody& wb,
                                     const LocalGround& ground) noexcept {
  for (const Leg leg : kLegs) {
    foothold_W_[leg] = wb.p_WF[leg];
    foothold_W_[leg].z() = ground.Height(wb.state, wb.p_WF[leg]);
  }
  FitPlane(wb.state.p_WB, 1.0, 1.0);
}

/// Least-squares plane through the four last footholds, low-passed; its height at the body is
/// filtered on its own.
void ReferencePlanner::FitPlane(const Vec3& p_WB, double slope_share,
                                double height_share) noexcept {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : foothold_W_) mean += p / kNumLegs;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Vec2 b = Vec2::Zero();
  for (const Vec3& p : foothold_W_) {
    const Vec2 d = (p - mean).head<2>();
    A += d * d.transpose();
    b += d * (p.z() - mean.z());
  }
  // Keeps the fit finite when the feet are nearly in a line; 1e-4 m² for a Go2.
  constexpr double kRidge = 1e-4 / (0.30 * 0.30);
  const double ridge_m2 = kRidge * nominal_height_m_ * nominal_height_m_;
  constexpr double kMaxSlope = 1.0;
  const Vec2 slope = (A + ridge_m2 * Eigen::Matrix2d::Identity()).inverse() * b;
  const Vec2 bounded = slope.cwiseMax(-kMaxSlope).cwiseMin(kMaxSlope);
  const double z_before = plane_.Height(p_WB);
  plane_.slope += slope_share * (bounded - plane_.slope);
  const double z_fit = mean.z() + plane_.slope.dot((p_WB - mean).head<2>());
  plane_.origin = p_WB.head<2>();
  plane_.z0_m = started_ ? z_before + height_share * (z_fit - z_before) : z_fit;
}

void ReferencePlanner::Ramp(const Command& command, double dt_s) noexcept {
  const double dv = params_.max_acceleration_mps2 * dt_s;
  v_H_.x() = Towards(v_H_.x(), command.v_x_mps, dv);
  v_H_.y() = Towards(v_H_.y(), command.v_y_mps, dv);
  w_z_ = Towards(w_z_, command.w_z_radps, params_.max_yaw_acceleration_radps2 * dt_s);
}

void ReferencePlanner::AdvanceDither(double dt_s) noexcept {
  const bool rests = v_H_.isZero(0.0) && w_z_ == 0.0;
  dither_m_ = rests ? params_.stand_dither_m : 0.0;
  const double turned_rad = dither_rad_ + kTurn_rad * params_.stand_dither_Hz * dt_s;
  dither_rad_ = rests ? std::fmod(turned_rad, kTurn_rad) : 0.0;
}

BodyReference ReferencePlanner::Plan(const core::WholeBody& wb, const Command& command, int horizon,
                                     double stage_s, double dt_s) noexcept {
  const double yaw = core::RpyFromRotation(wb.state.R_WB).z();
  if (!started_) {
    started_ = true;
    p_desired_W_ = wb.p_WC.head<2>();
    yaw_desired_rad_ = yaw;
  }
  Ramp(command, dt_s);
  AdvanceDither(dt_s);
  // Desired pose: integrate, then keep within reach of the measured pose.
  const double yaw_measured = core::UnwrapNear(yaw, yaw_desired_rad_);
  yaw_desired_rad_ =
      std::clamp(yaw_desired_rad_ + w_z_ * dt_s, yaw_measured - params_.max_yaw_lead_rad,
                 yaw_measured + params_.max_yaw_lead_rad);
  p_desired_W_ +=
      (core::RotationZ(yaw_desired_rad_) * Vec3(v_H_.x(), v_H_.y(), 0.0)).head<2>() * dt_s;
  Vec2 lead = p_desired_W_ - wb.p_WC.head<2>();
  if (lead.norm() > params_.max_position_lead_m) {
    lead *= params_.max_position_lead_m / lead.norm();
    p_desired_W_ = wb.p_WC.head<2>() + lead;
  }

  const double height_m = command.height_m > 0.0 ? command.height_m : nominal_height_m_;
  BodyReference reference;
  reference.n_W = plane_.Normal();
  reference.ground_z_m = plane_.Height(wb.p_WC);
  Vec3 p_WC(p_desired_W_.x(), p_desired_W_.y(), 0.0);
  double heading = yaw_desired_rad_;
  for (int k = 0; k <= horizon; ++k) {
    BodyReference::Stage& stage = reference.stages[static_cast<std::size_t>(k)];
    const Mat3 R_WH = core::RotationZ(heading);
    const Vec3 slope_H = R_WH.transpose() * Vec3(plane_.slope.x(), plane_.slope.y(), 0.0);
    stage.rpy_rad = {command.roll_rad + params_.tilt_share * std::atan(slope_H.y()),
                     command.pitch_rad - params_.tilt_share * std::atan(slope_H.x()), heading};
    const double dither_radps = kTurn_rad * params_.stand_dither_Hz;
    const double dither_rad = dither_rad_ + k * stage_s * dither_radps;
    p_WC.z() = plane_.Height(p_WC) + height_m + dither_m_ * std::sin(dither_rad);
    stage.p_WC = p_WC;
    stage.v_WC = R_WH * Vec3(v_H_.x(), v_H_.y(), 0.0);
    stage.v_WC.z() =
        plane_.slope.dot(stage.v_WC.head<2>()) + dither_m_ * dither_radps * std::cos(dither_rad);
    stage.w_WB = {0.0, 0.0, w_z_};
    p_WC.head<2>() += stage.v_WC.head<2>() * stage_s;
    heading += w_z_ * stage_s;
  }
  return reference;
}

}  // namespace scoria::controller
