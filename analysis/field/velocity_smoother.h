// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/math/types.h"
#include "core/robot/legs.h"

namespace scoria::analysis {

/// What legs and accelerometer tell of the velocity of the IMU at one instant, in W.
struct VelocityClue {
  double time_s = 0.0;
  LegArray<std::optional<Vec3>> v_WS = {};  // m/s, by each foot in contact, as if it held
  std::optional<Vec3> a_WS = std::nullopt;  // m/s², without gravity
};

/// Velocities at the times of clues, which the whole stretch tells: a Kalman smoother
/// ([Rauch1965]) that integrates the accelerometer, less a bias that walks, and takes each foot for
/// holding with errors of Student's t distribution, by iterated weights ([Lange1989]). So feet that
/// slip against what all of the others and the accelerometer say lose their weight, before and
/// after the moment. Where the accelerometer is missing the velocity walks instead.
/// @returns one for each clue, m/s, in W.
[[nodiscard]] std::vector<Vec3> SmoothVelocity(std::span<const VelocityClue> clues);

/// SmoothVelocity for stretches of any length: in blocks, each seen with its neighbourhood.
class VelocitySmoother {
 public:
  static constexpr double kBlock_s = 20.0, kOverlap_s = 5.0;

  /// Clues of one stretch come in the order of time.
  void Add(const VelocityClue& clue);
  /// The stretch has ended; the next clue begins another.
  void Finish();
  /// Velocities that have become known since the last call, one for each clue, in order.
  [[nodiscard]] std::vector<Vec3> Take();

 private:
  void GiveOut(std::size_t end);

  std::vector<VelocityClue> clues_;  // those from given_ on are not given out
  std::size_t given_ = 0;
  std::vector<Vec3> ready_;
};

}  // namespace scoria::analysis
