// SPDX-License-Identifier: BSD-3-Clause
#include "controller/adaptation/model_update_gate.h"

#include <algorithm>
#include <cmath>

namespace scoria::controller {

ModelUpdateGate::ModelUpdateGate(const UpdateGateParams& params,
                                 const core::RobotDescription& robot) noexcept
    : params_(params), robot_(robot) {
  for (const core::LegDescription& leg : robot.legs) {
    const Vec3 hip = leg.joints[0].p_PJ + leg.joints[0].R_PJ * leg.joints[1].p_PJ;
    hips_m_ = hips_m_.cwiseMax(hip.head<2>().cwiseAbs());
  }
}

Vec3 ModelUpdateGate::Clamp(const Vec3& dpi) const noexcept {
  if (!dpi.allFinite()) return Vec3::Zero();
  const core::Body& trunk = robot_.trunk;
  const double mass = std::clamp(trunk.mass_kg + dpi[0], params_.min_trunk_share * trunk.mass_kg,
                                 trunk.mass_kg + params_.max_payload_kg);
  const Vec2 nominal = trunk.mass_kg * trunk.p_OC.head<2>();
  const Vec2 c = (nominal + dpi.tail<2>()) / mass;
  const Vec2 inside = c.cwiseMax(-hips_m_).cwiseMin(hips_m_);
  Vec3 out;
  out << mass - trunk.mass_kg, mass * inside - nominal;
  return out;
}

Vec3 ModelUpdateGate::Continue(const core::ModelParameters& in_use) noexcept {
  const core::Body& trunk = robot_.trunk;
  const Vec2 excess =
      in_use.trunk.mass_kg * in_use.trunk.p_OC.head<2>() - trunk.mass_kg * trunk.p_OC.head<2>();
  used_ = goal_ = {in_use.trunk.mass_kg - trunk.mass_kg, excess.x(), excess.y()};
  return used_;
}

core::ModelParameters ModelUpdateGate::CalcTrunk(const Vec3& dpi) const noexcept {
  const core::Body& trunk = robot_.trunk;
  core::ModelParameters out;
  out.trunk.mass_kg = trunk.mass_kg + dpi[0];
  const Vec3 excess(dpi[1], dpi[2], dpi[0] * params_.payload_height_m);
  out.trunk.p_OC = (trunk.mass_kg * trunk.p_OC + excess) / out.trunk.mass_kg;
  if (dpi[0] <= 0.0) {
    // What was taken away may have been anywhere: a lighter trunk of the same shape.
    out.trunk.I_C = trunk.I_C * (out.trunk.mass_kg / trunk.mass_kg);
    return out;
  }
  // The place of a small mass is uncertain, but never outside the trunk.
  Vec3 p_BP = excess / dpi[0];
  p_BP.head<2>() = p_BP.head<2>().cwiseMax(-hips_m_).cwiseMin(hips_m_);
  const Vec3 d = p_BP - trunk.p_OC;
  const double reduced = trunk.mass_kg * dpi[0] / out.trunk.mass_kg;
  out.trunk.I_C = trunk.I_C + core::PointInertia(reduced, d);
  return out;
}

Adaptation ModelUpdateGate::Update(const Vec3& dpi_any, const Mat3& P,
                                   const core::WholeBody& nominal, double dt_s) noexcept {
  const Vec3 dpi = Clamp(dpi_any);
  const Vec3 limit(params_.max_sigma_kg, params_.max_sigma_kgm, params_.max_sigma_kgm);
  const Vec3 variance = P.diagonal();
  const Vec3 variance_ratio = variance.cwiseQuotient(limit.cwiseProduct(limit));
  // Each as soon as it is sure: the mass long before where it lies, which until then stays.
  for (int i = 0; i < 3; ++i) {
    if (variance_ratio[i] <= 1.0) goal_[i] = dpi[i];
  }

  const Vec3 step = dt_s * Vec3(params_.rate_kgps, params_.rate_kgmps, params_.rate_kgmps);
  const Vec3 next = Clamp(used_ + (goal_ - used_).cwiseMax(-step).cwiseMin(step));
  Adaptation out;
  out.changed = next != used_;
  used_ = next;
  out.parameters = CalcTrunk(used_);
  out.mass_kg = nominal.mass_kg + dpi[0];
  const Vec3 p_BC = nominal.state.R_WB.transpose() * (nominal.p_WC - nominal.state.p_WB);
  const Vec3 excess(dpi[1], dpi[2], dpi[0] * params_.payload_height_m);
  out.p_BC = (nominal.mass_kg * p_BC + excess) / out.mass_kg;
  out.P = P;
  out.quality = 1.0 / (1.0 + std::max(0.0, variance_ratio.maxCoeff()));
  return out;
}

}  // namespace scoria::controller
