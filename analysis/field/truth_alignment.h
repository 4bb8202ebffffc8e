// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "analysis/field/lever_arm.h"
#include "analysis/field/motion_samples.h"
#include "analysis/field/time_offset.h"

namespace scoria::analysis {

/// What a truth from outside the robot has to be corrected by before anything is compared with it.
struct TruthAlignment {
  TimeOffset offset;
  std::optional<LeverArm> lever_arm = std::nullopt;  // none: `why_no_lever_arm`
  std::string why_no_lever_arm = {};
};

struct TruthAlignmentResult {
  std::optional<TruthAlignment> alignment;
  std::string refusal;  // why there is none, in words; empty if there is
};

/// Finds time offset and lever arm of a log's truth: motion capture, or whatever else shows place
/// and attitude of a body M that is fixed to the trunk. Two passes over the log:
///
///     TruthAlignmentEstimator estimator(&robot);
///     ForEachRow(log, [&](const Row& row) { estimator.AddRow(row); });
///     const TruthAlignmentResult found = estimator.Estimate();
///     if (found.alignment) {
///       AlignedRows rows(*found.alignment, on_row);       // aligned_rows.h: rows whose truth is
///       ForEachRow(log, [&](const Row& row) { rows.Add(row); });   // the trunk's, in time
///       rows.Finish();
///     }
///
/// Needs gyroscope and truth; for the lever arm the accelerometer or an estimate: of both, that
/// with the smaller standard errors is taken. Keeps the first ten minutes of the log.
class TruthAlignmentEstimator {
 public:
  /// A lever arm whose standard error is larger is not told.
  static constexpr double kLargestSigma_m = 0.05;

  /// @param robot  where the IMU is on the trunk; borrowed; null: at its origin, in its axes.
  explicit TruthAlignmentEstimator(const core::RobotDescription* robot, double gravity_mps2 = 9.81);
  void AddRow(const logs::Row& row) { samples_.Add(row); }
  [[nodiscard]] TruthAlignmentResult Estimate() const;

 private:
  const core::RobotDescription* robot_;
  double gravity_mps2_;
  MotionSamples samples_;
};

/// One line for people: delay, axes and lever arm with their standard errors.
[[nodiscard]] std::string DescribeAlignment(const TruthAlignmentResult& result);

void to_json(nlohmann::json& j, const TruthAlignmentResult& result);

}  // namespace scoria::analysis
