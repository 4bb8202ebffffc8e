// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "logs/quality/quality_check.h"
#include "logs/quality/resampler.h"
#include "logs/quality/span_list.h"
#include "logs/quality/statistics.h"
#include "logs/quality/tick_history.h"

namespace scoria::logs {

/// Positions and velocities of estimate and truth against each other: units, the axes that a
/// velocity is in, jumps, and which way the robot walks.
class VelocityCheck : public QualityCheck {
 public:
  /// No legged robot has been so fast: a position that moves so is in another unit, and one that
  /// moves so within a moment has jumped.
  static constexpr double kLargestSpeed_mps = 20.0;

  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

 private:
  struct Course {
    Moments slope_squares, velocity_squares;  // of d position / dt, and of the velocity as read
    BlockMean body_gain;                      // cost of the velocity in W minus that of it in B
    Moments cost;                             // in W
    Moments inverse_cost;                     // of the opposite velocity
    Vec3 path_B = Vec3::Zero(), abs_path_B = Vec3::Zero();  // m; by the position
    SpanList jumps;
  };
  void AddCourse(std::size_t source);
  [[nodiscard]] std::vector<Finding> JudgeSource(std::size_t source,
                                                 const std::vector<Finding>& earlier) const;
  [[nodiscard]] std::optional<Finding> UnitFinding(std::size_t source) const;
  [[nodiscard]] std::optional<Finding> FrameFinding(std::size_t source) const;
  [[nodiscard]] std::optional<Finding> Backwards(std::size_t source) const;

  TickHistory<21> last_;
  std::array<Course, kNumMotionSources> courses_;
};

}  // namespace scoria::logs
