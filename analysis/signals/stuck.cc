// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/stuck.h"

#include <algorithm>

namespace scoria::analysis {

bool StuckDetector::Update(const StuckSample& sample) noexcept {
  const double enough_m =
      std::min(params_.stuck_distance_m, 0.5 * sample.commanded_mps * params_.stuck_s);
  const bool moved = anchor_W_ && (sample.p_W - *anchor_W_).norm() > enough_m;
  if (sample.commanded_mps <= 0.0 || moved || !anchor_W_) {
    anchor_W_ = sample.p_W;
    stuck_s_ = 0.0;
    return false;
  }
  stuck_s_ += sample.dt_s;
  if (stuck_s_ < params_.stuck_s) return false;
  anchor_W_.reset();
  return true;
}

void StuckDetector::Reset() noexcept {
  anchor_W_.reset();
  stuck_s_ = 0.0;
}

}  // namespace scoria::analysis
