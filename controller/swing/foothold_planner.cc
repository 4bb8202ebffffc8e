// SPDX-License-Identifier: BSD-3-Clause
#include "controller/swing/foothold_planner.h"

#include <algorithm>
#include <cmath>

#include "core/math/so3.h"

namespace scoria::controller {

FootholdPlanner::FootholdPlanner(const FootholdParams& params, const core::RobotDescription& robot,
                                 double gravity_mps2) noexcept
    : params_(params),
      robot_(robot),
      gravity_mps2_(gravity_mps2),
      velocity_(params.velocity_filter_samples) {}

Vec3 FootholdPlanner::Foothold(Leg leg, const Vec3& p_WB_touchdown, double yaw_rad, const Vec3& v_W,
                               const BodyReference::Stage& reference, double stance_s,
                               double height_m, const GroundPlane& plane) const noexcept {
  const Vec3 neutral = p_WB_touchdown + core::RotationZ(yaw_rad) * robot_.NeutralFoothold(leg);
  Vec3 reach = 0.5 * stance_s * v_W + params_.velocity_gain_s * (v_W - reference.v_WC) +
               0.5 * std::sqrt(std::max(height_m, 0.0) / gravity_mps2_) * v_W.cross(reference.w_WB);
  reach.z() = 0.0;
  if (reach.norm() > params_.max_reach_m) reach *= params_.max_reach_m / reach.norm();
  Vec3 p_WF = neutral + reach;
  p_WF.z() = plane.Height(p_WF) + robot_.legs[leg].foot_radius_m;
  return p_WF;
}

FootholdPlan FootholdPlanner::Plan(const WholeBody& wb, const ContactPlan& contacts,
                                   const BodyReference& reference,
                                   const GroundPlane& plane) noexcept {
  const Vec3 v_W = velocity_.Update(wb.v_WC);
  const double height_m = wb.p_WC.z() - plane.Height(wb.p_WC);
  const double yaw = core::RpyFromRotation(wb.state.R_WB).z();
  FootholdPlan plan;
  for (const Leg leg : kLegs) {
    const auto touchdown_after = [&](double delay_s) {
      // The body keeps to the reference velocity from where it is.
      const BodyReference::Stage& now = reference.stages[0];
      const Vec3 p_WB = wb.state.p_WB + now.v_WC * delay_s;
      // Symmetric about the middle of the stance that follows, also when turning.
      const double mid_stance_s = delay_s + 0.5 * contacts.stance_s[leg];
      return Foothold(leg, p_WB, yaw + now.w_WB.z() * mid_stance_s, v_W, now,
                      contacts.stance_s[leg], height_m, plane);
    };
    const double next_swing_s =
        contacts.stance[leg]
            ? (contacts.duty[leg] - contacts.phase[leg]) * contacts.period_s + contacts.swing_s[leg]
            : contacts.swing_remaining_s[leg];
    plan.next[leg] = contacts.standing ? wb.p_WF[leg] : touchdown_after(next_swing_s);
    Vec3 foothold = contacts.stance[leg] ? wb.p_WF[leg] : plan.next[leg];
    bool was_stance = true;
    for (int k = 0; k < contacts.horizon; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const bool stance = contacts.stage_stance[i][leg];
      if (stance && !was_stance) foothold = touchdown_after(k * contacts.dt_s);
      plan.stage[i][leg] = foothold;
      was_stance = stance;
    }
  }
  return plan;
}

}  // namespace scoria::controller
