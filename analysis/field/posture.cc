// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/posture.h"

#include <algorithm>
#include <cmath>

namespace scoria::analysis {

Posture::Posture(double nominal_height_m, double gravity_mps2) noexcept
    : nominal_m_(nominal_height_m),
      slow_mps_(kSlow * std::sqrt(gravity_mps2 * nominal_height_m)),
      stands_(nominal_height_m <= 0.0) {}

void Posture::Update(const FallSample& sample) noexcept {
  if (nominal_m_ <= 0.0 || !sample.height_m) return;
  constexpr double kForget_mps = 0.02;
  const double height_m = *sample.height_m;
  const bool is_level = sample.tilt_rad.value_or(0.0) < kLevel_rad;
  had_m_ = std::max(height_m, had_m_ - kForget_mps * sample.dt_s);
  since_full_s_ += sample.dt_s;
  level_ = level_ && is_level;
  if (height_m >= kFull * had_m_) {
    since_full_s_ = 0.0;
    level_ = is_level;
  }
  if (height_m >= kStands * nominal_m_ && is_level) stands_ = true;
  const bool was_low = is_low_;
  is_low_ = height_m < kLow * nominal_m_;
  if (is_low_ && !was_low) slow_ = level_ && kFull * had_m_ - height_m < slow_mps_ * since_full_s_;
}

}  // namespace scoria::analysis
