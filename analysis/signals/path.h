// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/math/types.h"

namespace scoria::analysis {

/// Where the trunk is at one instant, seen from above.
struct PathSample {
  double dt_s = 0.0;  // since the sample before
  Vec2 p_W = Vec2::Zero();
};

/// The way walked as an operator paces it: the sum of half-second chords on the map, from samples
/// of any rate.
class PathLength {
 public:
  /// @returns the length of the chord that ends with this sample, if one does.
  std::optional<double> Add(const PathSample& sample) noexcept;
  /// Counts the chord so far, where a fall or a placement ends it early. @returns its length.
  double CloseChord(const Vec2& p_W) noexcept;
  /// The robot was carried: the next chord starts where it is put down.
  void Lift() noexcept { chord_start_W_.reset(); }
  [[nodiscard]] double length_m() const noexcept { return length_m_; }

 private:
  std::optional<Vec2> chord_start_W_;
  double chord_s_ = 0.0, length_m_ = 0.0;
};

}  // namespace scoria::analysis
