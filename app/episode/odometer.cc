// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/odometer.h"

namespace scoria::app {

void Odometer::Update(const Vec2& p_W, double dt_s) {
  constexpr double kChord_s = 0.5;
  if (!chord_start_W_) {
    chord_start_W_ = p_W;
    chord_s_ = 0.0;
  }
  chord_s_ += dt_s;
  if (chord_s_ < kChord_s) return;
  CloseChord(p_W);
  chord_start_W_ = p_W;
  chord_s_ = 0.0;
}

void Odometer::CloseChord(const Vec2& p_W) {
  if (chord_start_W_) walked_m_ += (p_W - *chord_start_W_).norm();
  chord_start_W_.reset();
}

}  // namespace scoria::app
