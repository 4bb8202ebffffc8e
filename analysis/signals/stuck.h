// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "core/config/archive.h"
#include "core/math/types.h"

namespace scoria::analysis {

/// When a robot counts as stuck.
struct StuckParams {
  double stuck_distance_m = 0.5, stuck_s = 10.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("stuck_distance_m", stuck_distance_m,
            {.min = 0.0, .max = 10.0, .scale = core::dimension::kLength});
    a.Field("stuck_s", stuck_s,
            {.min = 1.0,
             .max = 1e4,
             .doc = "while commanded to walk",
             .scale = core::dimension::kTime});
  }
  bool operator==(const StuckParams&) const = default;
};

struct StuckSample {
  double dt_s = 0.0;  // since the sample before
  Vec2 p_W = Vec2::Zero();
  double commanded_mps = 0.0;
};

/// Finds in samples of any rate where a robot gets stuck: less than stuck_distance_m in stuck_s
/// while commanded to walk, or less than half of what a slow command asks for in that time. Turning
/// in place is not walking.
class StuckDetector {
 public:
  explicit StuckDetector(const StuckParams& params) noexcept : params_(params) {}

  /// @returns true once each time that it gets stuck.
  [[nodiscard]] bool Update(const StuckSample& sample) noexcept;

  /// After the robot was placed.
  void Reset() noexcept;

 private:
  StuckParams params_;
  std::optional<Vec2> anchor_W_;
  double stuck_s_ = 0.0;
};

}  // namespace scoria::analysis
