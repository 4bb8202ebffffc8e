// SPDX-License-Identifier: BSD-3-Clause
#include "sim/sliding_payload.h"

#include <fmt/format.h>

#include "core/math/so3.h"

namespace scoria::sim {

std::string SlidingPayloadParams::Problem() const {
  // rad/s: turns by half a radian in the longest step; semi-implicit Euler is stable below two.
  constexpr double kFastest_radps = 250.0;
  if (name.empty()) return "name: must not be empty";
  if (axis.norm() == 0.0) return "axis: must not be zero";
  const double stiffest = kFastest_radps * kFastest_radps * mass_kg;
  if (stiffness_N_per_m > stiffest) {
    return fmt::format("stiffness_N_per_m: the step resolves at most {:g} with this mass",
                       stiffest);
  }
  return "";
}

SlidingPayload::SlidingPayload(const SlidingPayloadParams& params, const Vec3& gravity_W)
    : params_(params), gravity_W_(gravity_W), axis_B_(params.axis.normalized()) {}

SlidingPayload::Coupling SlidingPayload::CalcCoupling(const RobotState& s) const noexcept {
  Coupling c;
  c.r_W = s.R_WB * (params_.p_BP_m + x_m_ * axis_B_);
  c.u_W = s.R_WB * axis_B_;
  const Vec3 bias_W = s.w_WB.cross(s.w_WB.cross(c.r_W)) + 2.0 * rate_mps_ * s.w_WB.cross(c.u_W);
  c.f_W = params_.mass_kg * (bias_W - gravity_W_);
  c.b << params_.mass_kg * c.u_W, params_.mass_kg * c.r_W.cross(c.u_W);
  return c;
}

double SlidingPayload::SlideImpulse(const Coupling& c, double dt_s) const noexcept {
  return -dt_s * (params_.stiffness_N_per_m * x_m_ + params_.damping_Ns_per_m * rate_mps_ +
                  c.u_W.dot(c.f_W));
}

/// m JᵀJ.
Mat6 SlidingPayload::LockedInertia(const Vec3& r_W) const noexcept {
  const Mat3 S = core::Skew(r_W);
  Mat6 out;
  out << Mat3::Identity(), -S, S, -S * S;
  return params_.mass_kg * out;
}

void SlidingPayload::AddTo(core::WholeBody& wb, double dt_s) const noexcept {
  const Coupling c = CalcCoupling(wb.state);
  const double d = params_.mass_kg + params_.damping_Ns_per_m * dt_s;
  wb.H_BB += LockedInertia(c.r_W) - c.b * c.b.transpose() / d;
  Vec6 h;
  h << c.f_W, c.r_W.cross(c.f_W);
  wb.h_B += h + SlideImpulse(c, dt_s) / (d * dt_s) * c.b;
}

Mat6 SlidingPayload::CalcImpactInertia(const RobotState& state) const noexcept {
  const Coupling c = CalcCoupling(state);
  return LockedInertia(c.r_W) - c.b * c.b.transpose() / params_.mass_kg;
}

double SlidingPayload::Step(const RobotState& before, const Vec6& change, double dt_s) noexcept {
  const Coupling c = CalcCoupling(before);
  const double d = params_.mass_kg + params_.damping_Ns_per_m * dt_s;
  const double old_mps = rate_mps_;
  rate_mps_ += (SlideImpulse(c, dt_s) - c.b.dot(change)) / d;
  x_m_ += dt_s * rate_mps_;
  return -dt_s * params_.damping_Ns_per_m * rate_mps_ * 0.5 * (old_mps + rate_mps_);
}

void SlidingPayload::Kick(const RobotState& before, const Vec6& change) noexcept {
  rate_mps_ -= CalcCoupling(before).b.dot(change) / params_.mass_kg;
}

Vec3 SlidingPayload::CalcPosition(const RobotState& s) const noexcept {
  return s.p_WB + s.R_WB * (params_.p_BP_m + x_m_ * axis_B_);
}

Vec3 SlidingPayload::CalcVelocity(const RobotState& s) const noexcept {
  return s.v_WB + s.w_WB.cross(CalcPosition(s) - s.p_WB) + rate_mps_ * (s.R_WB * axis_B_);
}

double SlidingPayload::CalcKineticEnergy(const RobotState& s) const noexcept {
  return 0.5 * params_.mass_kg * CalcVelocity(s).squaredNorm();
}

double SlidingPayload::CalcPotentialEnergy(const RobotState& s, double dt_s) const noexcept {
  const Vec3 p_WP_then = CalcPosition(s) - 0.5 * dt_s * CalcVelocity(s);
  const double x_then_m = x_m_ - 0.5 * dt_s * rate_mps_;
  return -params_.mass_kg * gravity_W_.dot(p_WP_then) +
         0.5 * params_.stiffness_N_per_m * x_then_m * x_then_m;
}

}  // namespace scoria::sim
