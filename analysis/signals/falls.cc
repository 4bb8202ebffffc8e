// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/falls.h"

namespace scoria::analysis {

FallDetector::FallDetector(const FallParams& params, double nominal_trunk_height_m) noexcept
    : params_(params), nominal_height_m_(nominal_trunk_height_m) {}

FallCause FallDetector::Update(const FallSample& sample) noexcept {
  const bool pressed = sample.trunk_force_N && *sample.trunk_force_N > params_.trunk_force_N;
  const bool low = sample.height_m && *sample.height_m < params_.height_share * nominal_height_m_;
  const bool tilted = sample.tilt_rad && *sample.tilt_rad > params_.tilt_rad;
  pressed_s_ = pressed ? pressed_s_ + sample.dt_s : 0.0;
  low_s_ = low ? low_s_ + sample.dt_s : 0.0;
  const bool sound = !pressed && !low && !tilted;
  if (state_ == FallState::kFallen) {
    sound_s_ = sound ? sound_s_ + sample.dt_s : 0.0;
    if (sound_s_ >= kRecover_s) Reset();
    return FallCause::kNone;
  }
  state_ = sound ? FallState::kUpright : FallState::kStumbling;
  return Enter(tilted                               ? FallCause::kTilt
               : pressed_s_ > params_.trunk_force_s ? FallCause::kTrunkContact
               : low_s_ > params_.height_s          ? FallCause::kLow
                                                    : FallCause::kNone);
}

FallCause FallDetector::UpdateStandUp(const FallSample& sample, double overdue_s) noexcept {
  if (state_ == FallState::kFallen) return FallCause::kNone;
  const bool tilted = sample.tilt_rad && *sample.tilt_rad > params_.tilt_rad;
  return Enter(tilted                           ? FallCause::kTilt
               : overdue_s > params_.stand_up_s ? FallCause::kNotStanding
                                                : FallCause::kNone);
}

FallCause FallDetector::Enter(FallCause cause) noexcept {
  if (cause != FallCause::kNone) {
    state_ = FallState::kFallen;
    sound_s_ = 0.0;
  }
  return cause;
}

void FallDetector::Reset() noexcept {
  state_ = FallState::kUpright;
  pressed_s_ = low_s_ = sound_s_ = 0.0;
}

}  // namespace scoria::analysis
