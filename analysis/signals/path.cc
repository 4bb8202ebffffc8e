// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/path.h"

namespace scoria::analysis {

std::optional<double> PathLength::Add(const PathSample& sample) noexcept {
  constexpr double kChord_s = 0.5, kRounding_s = 1e-9;
  if (!chord_start_W_) {
    chord_start_W_ = sample.p_W;
    chord_s_ = 0.0;
  }
  chord_s_ += sample.dt_s;
  if (chord_s_ < kChord_s - kRounding_s) return std::nullopt;
  const double chord_m = CloseChord(sample.p_W);
  chord_start_W_ = sample.p_W;
  chord_s_ = 0.0;
  return chord_m;
}

double PathLength::CloseChord(const Vec2& p_W) noexcept {
  const double chord_m = chord_start_W_ ? (p_W - *chord_start_W_).norm() : 0.0;
  length_m_ += chord_m;
  chord_start_W_.reset();
  return chord_m;
}

}  // namespace scoria::analysis
