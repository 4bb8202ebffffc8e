// SPDX-License-Identifier: BSD-3-Clause
#include "controller/swing/foothold_planner.h"

#include <algorithm>
#include <cmath>

#include "controller/swing/reach.h"
#include "core/math/so3.h"

namespace scoria::controller {

FootholdPlanner::FootholdPlanner(const FootholdParams& params, const core::RobotDescription& robot,
                                 double gravity_mps2) noexcept
    : params_(params),
      robot_(robot),
      gravity_mps2_(gravity_mps2),
      velocity_(params.velocity_filter_samples) {}

/// The body keeps to the reference velocity from where it is; the step is symmetric about the
/// middle of its stance, also when turning.
Vec3 FootholdPlanner::TouchdownAfter(const Tick& t, Leg leg, double delay_s) const noexcept {
  const double stance_s = t.contacts.stance_s[leg];
  const Vec3 p_WB = t.wb.state.p_WB + t.reference.v_WC * delay_s;
  const Mat3 R_WH = core::RotationZ(t.yaw_rad + t.reference.w_WB.z() * (delay_s + 0.5 * stance_s));
  Vec3 reach =
      0.5 * stance_s * t.v_W + params_.velocity_gain_s * (t.v_W - t.reference.v_WC) +
      0.5 * std::sqrt(std::max(t.height_m, 0.0) / gravity_mps2_) * t.v_W.cross(t.reference.w_WB);
  reach.z() = 0.0;
  if (reach.norm() > params_.max_reach_m) reach *= params_.max_reach_m / reach.norm();
  Vec3 p_WF = p_WB + R_WH * robot_.NeutralFoothold(leg) + reach;
  p_WF.z() = t.GroundHeight(p_WF) + robot_.legs[leg].foot_radius_m;
  const Vec3 step = p_WF - last_W_[leg];
  if (std::abs(step.z()) > params_.max_step_height_m)
    p_WF = last_W_[leg] + params_.max_step_height_m / std::abs(step.z()) * step;
  return ClipToReach(robot_, leg, p_WB, R_WH, p_WF);
}

double FootholdPlanner::DistanceFromNeutral(const core::WholeBody& wb, Leg leg) const noexcept {
  const Mat3 R_WH = core::RotationZ(core::RpyFromRotation(wb.state.R_WB).z());
  return (wb.p_BF_W[leg] - R_WH * robot_.NeutralFoothold(leg)).head<2>().norm();
}

FootholdPlan FootholdPlanner::Plan(const core::WholeBody& wb, const ContactPlan& contacts,
                                   const LegPhases& legs, const BodyReference& reference,
                                   const GroundPlane& plane, const LocalGround* ground) noexcept {
  const Tick tick{wb,
                  contacts,
                  reference.stages[0],
                  plane,
                  ground,
                  velocity_.Update(wb.v_WC),
                  wb.p_WC.z() - plane.Height(wb.p_WC),
                  core::RpyFromRotation(wb.state.R_WB).z()};
  FootholdPlan plan;
  plan.plane = plane;
  for (const Leg leg : kLegs) {
    if (legs.InContact(leg) || !started_) last_W_[leg] = wb.p_WF[leg];
  }
  started_ = true;
  for (const Leg leg : kLegs) {
    const double remaining_stance_s =
        (contacts.duty[leg] - contacts.phase[leg]) * contacts.period_s;
    const double next_s = contacts.stance[leg] ? remaining_stance_s + contacts.swing_s[leg]
                                               : contacts.swing_remaining_s[leg];
    plan.next[leg] = contacts.standing ? wb.p_WF[leg] : TouchdownAfter(tick, leg, next_s);
    // Stands here, or is in the air: until its first lift-off or touchdown in the plan.
    bool was_stance = legs.InContact(leg) || contacts.stance[leg];
    Vec3 foothold = was_stance ? wb.p_WF[leg] : plan.next[leg];
    int touchdowns = 0;
    for (int k = 0; k < contacts.horizon; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const bool waits = legs.mode[leg] == LegMode::kEarlyContact &&
                         k * contacts.dt_s < contacts.swing_remaining_s[leg];
      const bool stance = waits || contacts.stage_stance[i][leg];
      if (stance && !was_stance)
        foothold =
            touchdowns++ == 0 ? plan.next[leg] : TouchdownAfter(tick, leg, k * contacts.dt_s);
      plan.stage[i][leg] = foothold;
      was_stance = stance;
    }
  }
  return plan;
}

}  // namespace scoria::controller
