// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "analysis/signals/falls.h"

namespace scoria::analysis {

/// Whether a robot stands, of a log that does not tell when its walking controller is in charge: it
/// lies until it has stood up, at kStands of its nominal height, and may lie down of itself. That
/// is a descent from kFull of the height that it had down to kLow of the nominal one, level, and
/// slower than kSlow √(g h); legs that give way let it fall faster.
class Posture {
 public:
  static constexpr double kStands = 0.75, kFull = 0.9, kLow = 0.6, kLevel_rad = 0.52, kSlow = 0.3;

  /// @param nominal_height_m  of the trunk; 0: not known, it always stands.
  Posture(double nominal_height_m, double gravity_mps2) noexcept;

  void Update(const FallSample& sample) noexcept;
  [[nodiscard]] bool stands() const noexcept { return stands_; }
  /// It is low, and came down as one that lies down.
  [[nodiscard]] bool CameDownSlowly() const noexcept { return is_low_ && slow_; }
  /// It has lain down.
  void Lie() noexcept { stands_ = false; }

 private:
  double nominal_m_, slow_mps_;
  bool stands_;
  double had_m_ = 0.0;         // its height, which is forgotten
  double since_full_s_ = 0.0;  // since it was as high
  bool level_ = true;          // since then
  bool is_low_ = false, slow_ = false;
};

}  // namespace scoria::analysis
