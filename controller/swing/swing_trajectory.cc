// SPDX-License-Identifier: BSD-3-Clause
#include "controller/swing/swing_trajectory.h"

#include <algorithm>
#include <utility>

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

FootTargets SwingTrajectory::Plan(const core::WholeBody& wb, const LegPhases& legs,
                                  const FootholdPlan& footholds) noexcept {
  FootTargets targets;
  for (const Leg leg : kLegs) {
    FootTarget& target = targets[leg];
    const LegMode mode = legs.mode[leg], last_mode = std::exchange(last_mode_[leg], mode);
    if (legs.InContact(leg)) {
      target.p_WF = wb.p_WF[leg];
      continue;
    }
    const double s = std::clamp(legs.swing_progress[leg], 0.0, 1.0);
    if (mode == LegMode::kSwing && last_mode != LegMode::kSwing) {
      lift_off_W_[leg] = wb.p_WF[leg];
      goal_W_[leg] = footholds.next[leg];
    }
    if (s <= params_.retarget_until) goal_W_[leg] = footholds.next[leg];
    const Vec3 &from = lift_off_W_[leg], &to = goal_W_[leg];
    if (mode == LegMode::kLateContact) {
      const Vec3 below = to - Vec3(0.0, 0.0, params_.lower_speed_mps * legs.late_s[leg]);
      target.p_WF = ClipToReach(robot_, leg, wb.state.p_WB, wb.state.R_WB, below);
      target.v_WF = {0.0, 0.0, -params_.lower_speed_mps};
      continue;
    }
    const double rate = 1.0 / legs.swing_s[leg];
    const Blend along(s);
    target.p_WF = from + along.value * (to - from);
    target.v_WF = rate * along.first * (to - from);
    target.a_WF = rate * rate * along.second * (to - from);
    const double apex = std::max(from.z(), to.z()) + params_.apex_m;
    const bool rising = s < 0.5;
    const Blend half(rising ? 2.0 * s : 2.0 * s - 1.0);
    const double start = rising ? from.z() : apex, rise = rising ? apex - from.z() : to.z() - apex;
    target.p_WF.z() = start + half.value * rise;
    target.v_WF.z() = 2.0 * rate * half.first * rise;
    target.a_WF.z() = 4.0 * rate * rate * half.second * rise;
  }
  return targets;
}

}  // namespace scoria::controller
