// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/math/types.h"

namespace scoria::app {

/// The way walked as an operator paces it: the sum of half-second chords on the map.
class Odometer {
 public:
  void Update(const Vec2& p_W, double dt_s);
  /// Counts the chord so far, where a fall or a placement ends it early.
  void CloseChord(const Vec2& p_W);
  /// The robot was carried: the next chord starts where it is put down.
  void Lift() { chord_start_W_.reset(); }
  [[nodiscard]] double walked_m() const { return walked_m_; }

 private:
  std::optional<Vec2> chord_start_W_;
  double chord_s_ = 0.0, walked_m_ = 0.0;
};

}  // namespace scoria::app
