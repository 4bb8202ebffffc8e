// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/row_falls.h"

#include <algorithm>
#include <cmath>

namespace scoria::analysis {

std::optional<FallSample> FindFallSample(const logs::Row& row, MotionSource source, double dt_s) {
  const auto motion = FindMotion(row, source);
  if (!motion) return std::nullopt;
  FallSample sample{.dt_s = dt_s};
  const double up = std::cos(motion->rpy_rad.x()) * std::cos(motion->rpy_rad.y());
  sample.tilt_rad = std::acos(std::clamp(up, -1.0, 1.0));
  if (motion->ground_z_m) sample.height_m = motion->p_WB.z() - *motion->ground_z_m;
  if (source == MotionSource::kTruth && row.true_contacts)
    sample.trunk_force_N = row.true_contacts->trunk_force_N;
  return sample;
}

void RowFalls::Add(const logs::Row& row) {
  const auto sample = FindFallSample(row, source_, last_s_ ? row.time_s - *last_s_ : 0.0);
  if (!sample) return;
  last_s_ = row.time_s;
  const bool standing_up = row.episode && !row.episode->operating;
  if (row.episode) {
    if (segment_ && row.episode->segment != *segment_) detector_.Reset();
    segment_ = row.episode->segment;
  }
  constexpr double kNotOverdue_s = -1.0;  // rows do not say when standing up should have ended
  const FallCause cause =
      standing_up ? detector_.UpdateStandUp(*sample, kNotOverdue_s) : detector_.Update(*sample);
  if (cause == FallCause::kNone) return;
  const Vec2 p_WB = FindMotion(row, source_).value().p_WB.head<2>();
  falls_.push_back({row.time_s, std::string(core::EnumName(cause)), p_WB});
}

}  // namespace scoria::analysis
