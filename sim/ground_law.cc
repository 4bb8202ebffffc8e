// SPDX-License-Identifier: BSD-3-Clause
#include "sim/ground_law.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scoria::sim {
namespace {

double CutArea(double radius_m, double sinkage_m) noexcept {
  const double z = std::clamp(sinkage_m, 0.0, radius_m);
  return std::numbers::pi * z * (2.0 * radius_m - z);
}

double DampingOf(double ratio, double stiffness_N_per_m, double load_kg) noexcept {
  return 2.0 * ratio * std::sqrt(stiffness_N_per_m * load_kg);
}

}  // namespace

double CalcSinkageForce(const terrains::GroundSample& ground, double radius_m,
                        double sinkage_m) noexcept {
  if (sinkage_m <= 0.0) return 0.0;
  const double below_m = std::max(0.0, sinkage_m - ground.depth_m);
  const double step = ground.substrate_N_per_m3 - ground.layer_N_per_m3;
  return ground.layer_N_per_m3 * CutArea(radius_m, sinkage_m) * sinkage_m +
         std::max(0.0, step) * CutArea(radius_m, below_m) * below_m;
}

FootGround::FootGround(const GroundParams& params, double radius_m, double load_kg) noexcept
    : remembers_(std::holds_alternative<PlasticGround>(params)),
      radius_m_(radius_m),
      load_kg_(load_kg) {
  if (remembers_) law_ = std::get<PlasticGround>(params);
}

void FootGround::Prepare(const terrains::GroundSample& ground, const Vec3& p_WP,
                         double approach_mps, double dt_s, ContactPoint& contact) noexcept {
  if ((p_WP - p_WI_).head<2>().norm() > radius_m_) deepest_m_ = 0.0;
  constexpr double kLeast_m = 1e-5;  // the law has no stiffness at the very surface
  const double sinkage_m = -contact.gap_m;
  const double ahead_m =
      std::max({sinkage_m, sinkage_m + approach_mps * dt_s, deepest_m_, kLeast_m});
  contact.rest_m = deepest_m_ * (1.0 - 1.0 / law_.unloading_ratio);
  contact.stiffness_N_per_m =
      CalcSinkageForce(ground, radius_m_, ahead_m) / (ahead_m - contact.rest_m);
  contact.damping_Ns_per_m = DampingOf(ground.damping_ratio, contact.stiffness_N_per_m, load_kg_);
  contact.friction = ground.friction;
  if (law_.shear_displacement_m <= 0.0) return;
  // Secant of Janosi's curve at the present displacement.
  constexpr double kLeast_N = 1.0;
  const double K = law_.shear_displacement_m, j = shear_W_.norm();
  const double share = j > 1e-6 * K ? -std::expm1(-j / K) / j : 1.0 / K;
  contact.shear_stiffness_N_per_m = ground.friction * std::max(normal_N_, kLeast_N) * share;
  contact.shear_W = shear_W_;
}

void FootGround::Finish(const ContactPoint& contact, const Vec3& p_WP, double dt_s) noexcept {
  if (!remembers_) return;
  normal_N_ = contact.n_W.dot(contact.impulse_W) / dt_s;
  if (normal_N_ <= 0.0) return Lift();
  const Vec3 slip_W = dt_s * (contact.v_W - contact.n_W * contact.n_W.dot(contact.v_W));
  Shear(slip_W, contact.n_W);
  deepest_m_ =
      std::max(deepest_m_ * std::max(0.0, 1.0 - slip_W.norm() / radius_m_), -contact.gap_m);
  p_WI_ = p_WP;
}

/// Slip that shears further counts once; slip back counts unloading_ratio times, so that sheared
/// ground gives back only that share of its work.
void FootGround::Shear(const Vec3& slip_W, const Vec3& n_W) noexcept {
  constexpr double kMobilised = 5.0;  // times K: all of the friction
  const double stretch_m = shear_W_.norm();
  Vec3 slip = slip_W;
  if (stretch_m > 0.0) {
    const Vec3 along = shear_W_ / stretch_m;
    const double back_m = -slip.dot(along);
    if (back_m > 0.0) {
      const double counted_m = std::min(law_.unloading_ratio * back_m, stretch_m + back_m);
      slip -= (counted_m - back_m) * along;
    }
  }
  shear_W_ += slip;
  shear_W_ -= n_W * n_W.dot(shear_W_);
  const double longest_m = kMobilised * law_.shear_displacement_m, length_m = shear_W_.norm();
  if (length_m > longest_m) shear_W_ *= longest_m / length_m;
}

void FootGround::Lift() noexcept {
  shear_W_.setZero();
  normal_N_ = 0.0;
}

void PrepareBodyContact(const terrains::GroundSample& ground, double load_kg,
                        ContactPoint& contact) noexcept {
  constexpr double kCorner_m = 0.03, kLeast_m = 1e-3;  // radius; depth at which it is judged
  constexpr double kSoftest_N_per_m = 2e3, kStiffest_N_per_m = 2e5;
  const double depth_m = std::max(-contact.gap_m, kLeast_m);
  contact.stiffness_N_per_m = std::clamp(CalcSinkageForce(ground, kCorner_m, depth_m) / depth_m,
                                         kSoftest_N_per_m, kStiffest_N_per_m);
  contact.damping_Ns_per_m = DampingOf(ground.damping_ratio, contact.stiffness_N_per_m, load_kg);
  contact.friction = ground.friction;
}

}  // namespace scoria::sim
