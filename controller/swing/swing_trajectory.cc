// SPDX-License-Identifier: BSD-3-Clause
#include "controller/swing/swing_trajectory.h"

#include <algorithm>

#include "controller/swing/reach.h"

namespace scoria::controller {
namespace {

/// Cubic Bezier curve with control values 0, 0, 1, 1 and its derivatives with respect to s.
struct Blend {
  double value, first, second;
  explicit Blend(double s) noexcept
      : value(s * s * (3.0 - 2.0 * s)), first(6.0 * s * (1.0 - s)), second(6.0 - 12.0 * s) {}
};

}  // namespace

SwingTrajectory::Arc SwingTrajectory::StartArc(const core::WholeBody& wb, const LegPhases& legs,
                                               Leg leg, const Vec3& to_W) const noexcept {
  constexpr double kPause = 0.3;   // a foot that stumbled first goes up for this share of the rest
  constexpr double kLatest = 0.9;  // of the progress; a later start could not reach the foothold
  Arc arc;
  arc.mode = legs.mode[leg];
  arc.from_W = wb.p_WF[leg];
  arc.to_W = to_W;
  arc.held_B = wb.state.R_WB.transpose() * wb.p_BF_W[leg];
  if (arc.mode == LegMode::kStumble) {
    arc.start = std::clamp(legs.swing_progress[leg], 0.0, kLatest);
    arc.pause = kPause;
    arc.lift_m = params_.stumble_lift_m;
  }
  return arc;
}

/// @param ground_z_m height of a foot's centre on the ground plane half way.
FootTarget SwingTrajectory::AlongArc(const Arc& arc, const LegPhases& legs, Leg leg,
                                     double ground_z_m) const noexcept {
  FootTarget target;
  const Vec3 &from = arc.from_W, &to = arc.to_W;
  const double rate = 1.0 / (legs.swing_s[leg] * (1.0 - arc.start));
  const double s = std::clamp((legs.swing_progress[leg] - arc.start) / (1.0 - arc.start), 0.0, 1.0);
  const double rate_along = rate / (1.0 - arc.pause);
  const Blend along(std::max(0.0, (s - arc.pause) / (1.0 - arc.pause)));
  target.p_WF = from + along.value * (to - from);
  target.v_WF = rate_along * along.first * (to - from);
  target.a_WF = rate_along * rate_along * along.second * (to - from);
  const double apex = std::max({from.z(), to.z(), ground_z_m}) + params_.apex_m + arc.lift_m;
  const bool rising = s < 0.5;
  const Blend half(rising ? 2.0 * s : 2.0 * s - 1.0);
  const double start = rising ? from.z() : apex, rise = rising ? apex - from.z() : to.z() - apex;
  target.p_WF.z() = start + half.value * rise;
  target.v_WF.z() = 2.0 * rate * half.first * rise;
  target.a_WF.z() = 4.0 * rate * rate * half.second * rise;
  return target;
}

FootTarget SwingTrajectory::Wait(const core::WholeBody& wb, const LegPhases& legs, Leg leg,
                                 const Arc& arc) const noexcept {
  FootTarget target;
  if (legs.mode[leg] == LegMode::kHolding) {
    const Vec3 p_BF_W = wb.state.R_WB * arc.held_B;
    target.p_WF = wb.state.p_WB + p_BF_W;
    target.v_WF = wb.state.v_WB + wb.state.w_WB.cross(p_BF_W);
    return target;
  }
  const Vec3 below = arc.to_W - Vec3(0.0, 0.0, params_.lower_speed_mps * legs.late_s[leg]);
  target.p_WF = ClipToReach(robot_, leg, wb.state.p_WB, wb.state.R_WB, below);
  target.v_WF = {0.0, 0.0, -params_.lower_speed_mps};
  return target;
}

FootTargets SwingTrajectory::Plan(const core::WholeBody& wb, const LegPhases& legs,
                                  const FootholdPlan& footholds, double lift_m) noexcept {
  FootTargets targets;
  for (const Leg leg : kLegs) {
    Arc& arc = arcs_[leg];
    const LegMode mode = legs.mode[leg];
    if (legs.InContact(leg)) {
      arc.mode = mode;
      targets[leg].p_WF = wb.p_WF[leg];
      continue;
    }
    const bool swings = mode == LegMode::kSwing || mode == LegMode::kStumble;
    if (mode != arc.mode) {
      // A late foot is lowered from the foothold it aimed at, one that lost the ground from there.
      const bool late = arc.mode == LegMode::kSwing || arc.mode == LegMode::kStumble;
      const Vec3 lowered_from = late ? arc.to_W : wb.p_WF[leg];
      arc = StartArc(wb, legs, leg, swings ? footholds.next[leg] : lowered_from);
      arc.lift_m += lift_m;
    }
    if (!swings) {
      targets[leg] = Wait(wb, legs, leg, arc);
      continue;
    }
    if (legs.swing_progress[leg] <= params_.retarget_until) arc.to_W = footholds.next[leg];
    const Vec3 middle = 0.5 * (arc.from_W + arc.to_W);
    targets[leg] =
        AlongArc(arc, legs, leg, footholds.plane.Height(middle) + robot_.legs[leg].foot_radius_m);
  }
  return targets;
}

}  // namespace scoria::controller
