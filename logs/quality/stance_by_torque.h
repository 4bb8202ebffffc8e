// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

#include "core/robot/legs.h"

namespace scoria::logs {

/// Which legs bear load, by the size of their torques alone: whatever the order, signs and zeros of
/// the joints within a leg are, it stays the same.
class StanceByTorque {
 public:
  /// A leg in the air moves itself, a leg on the ground the robot: their torques differ by more
  /// than twice. The large ones are those of nine tenths of all.
  static constexpr double kLoaded = 0.4, kLarge = 0.9;

  /// @param least_Nm  a leg with smaller torques bears nothing: of a robot that may lie.
  explicit StanceByTorque(double least_Nm = 0.0) : least_Nm_(least_Nm) {}

  /// @returns none in the first quarter of a second.
  LegArray<bool> Update(const LegArray<Vec3>& tau);

 private:
  static constexpr std::size_t kBins = 96;  // an eighth of an octave each, from 0.01 Nm on
  void UpdateThreshold();
  double least_Nm_;
  std::array<std::uint32_t, kBins> histogram_{};
  std::uint64_t count_ = 0;
  double threshold_Nm_ = 0.0;
};

}  // namespace scoria::logs
