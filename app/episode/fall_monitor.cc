// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/fall_monitor.h"

#include <algorithm>
#include <cmath>

namespace scoria::app {

FallMonitor::FallMonitor(const FallParams& params, double nominal_trunk_height_m,
                         double step_s) noexcept
    : params_(params), nominal_height_m_(nominal_trunk_height_m), step_s_(step_s) {}

FallCause FallMonitor::Update(const sim::Truth& truth, double ground_z_m) noexcept {
  pressed_s_ = truth.trunk_force_N > params_.trunk_force_N ? pressed_s_ + step_s_ : 0.0;
  const double height_m = truth.state.p_WB.z() - ground_z_m;
  low_s_ = height_m < params_.height_share * nominal_height_m_ ? low_s_ + step_s_ : 0.0;
  if (HasTipped(truth)) return FallCause::kTilt;
  if (pressed_s_ > params_.trunk_force_s) return FallCause::kTrunkContact;
  if (low_s_ > params_.height_s) return FallCause::kLow;
  return FallCause::kNone;
}

FallCause FallMonitor::UpdateStandUp(const sim::Truth& truth, double overdue_s) const noexcept {
  if (HasTipped(truth)) return FallCause::kTilt;
  return overdue_s > params_.stand_up_s ? FallCause::kNotStanding : FallCause::kNone;
}

bool FallMonitor::HasTipped(const sim::Truth& truth) const noexcept {
  return std::acos(std::clamp(truth.state.R_WB(2, 2), -1.0, 1.0)) > params_.tilt_rad;
}

bool FallMonitor::UpdateStuck(const Vec3& p_WB, double commanded_mps) noexcept {
  const bool commanded = commanded_mps > 0.0;
  const double enough_m = std::min(params_.stuck_distance_m, 0.5 * commanded_mps * params_.stuck_s);
  const bool moved = (p_WB.head<2>() - anchor_W_).norm() > enough_m;
  if (!commanded || moved || !anchored_) {
    anchor_W_ = p_WB.head<2>();
    anchored_ = true;
    stuck_s_ = 0.0;
    return false;
  }
  stuck_s_ += step_s_;
  if (stuck_s_ < params_.stuck_s) return false;
  anchored_ = false;
  return true;
}

void FallMonitor::Reset() noexcept {
  pressed_s_ = low_s_ = stuck_s_ = 0.0;
  anchored_ = false;
}

}  // namespace scoria::app
