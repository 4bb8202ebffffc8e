// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "analysis/metrics/estimation_metrics.h"
#include "core/math/types.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Errors of an estimated trajectory against the truth of the same body at the same times.
struct TrajectoryError {
  std::uint64_t samples = 0;  // of the stretches that count
  int stretches = 0;          // between placements
  int standing = 0;           // stretches left out: the robot stood, which yaw cannot be aligned by
  double largest_distance_m = 0.0;  // from the start of a stretch, of all of them
  /// Absolute trajectory error: root mean square distance after the best alignment of each stretch
  /// by yaw and translation ([Zhang2018]).
  double ate_m = 0.0, ate_horizontal_m = 0.0, ate_vertical_m = 0.0;
  /// Relative pose errors, from the start's place and yaw on (see DriftTracker).
  RelativePoseError rpe_1m, rpe_10m;

  /// Why there is no error, in words; empty if there is.
  [[nodiscard]] std::string Refusal() const;
};

/// Takes pairs as they come; memory does not grow with them.
class TrajectoryErrorAccumulator {
 public:
  /// A stretch that leads less far from its start is of a standing robot.
  static constexpr double kLeastDistance_m = 0.5;

  void Add(const PosePair& now);
  /// Truth and estimate of a row, where it has both. Of a row with an episode they count while the
  /// robot walks; falls and placements end a stretch.
  void AddRow(const logs::Row& row);
  /// The robot was placed elsewhere, or either trajectory begins anew.
  void Break();
  [[nodiscard]] TrajectoryError Finish();

 private:
  /// Sums of a stretch, from its first sample on.
  struct Stretch {
    std::uint64_t count = 0;
    Vec3 origin_true = Vec3::Zero(), origin_est = Vec3::Zero();
    Vec3 sum_true = Vec3::Zero(), sum_est = Vec3::Zero();
    Mat3 products = Mat3::Zero();  // true est^T
    double squares_xy = 0.0, squares_z = 0.0;
    double largest_distance_m = 0.0;
  };
  bool walks_ = false;
  std::uint32_t segment_ = 0;
  Stretch stretch_;
  DriftTracker drift_;
  TrajectoryError error_;
  double sum_horizontal_m2_ = 0.0, sum_vertical_m2_ = 0.0;
};

void to_json(nlohmann::json& j, const TrajectoryError& error);

}  // namespace scoria::analysis
