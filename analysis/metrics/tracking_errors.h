// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "analysis/signals/stride_mean.h"
#include "core/math/types.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Means and root mean squares over steady walking (three seconds after the command changed, or
/// later).
struct TrackingErrors {
  double samples_s = 0.0;  // steady; without them nothing below was measured
  /// Horizontal, averaged over a stride first.
  std::optional<double> velocity_rmse_mps = std::nullopt;
  double velocity_x_mps = 0.0, velocity_y_mps = 0.0, yaw_rate_radps = 0.0;  // means in H
  double command_x_mps = 0.0, command_y_mps = 0.0, command_yaw_radps = 0.0;
  /// Of the centre of mass, and of the trunk, against the reference.
  std::optional<double> height_rmse_m = std::nullopt, roll_rmse_rad = std::nullopt,
                        pitch_rmse_rad = std::nullopt;
  /// Largest distance from where steady standing began.
  std::optional<double> drift_m = std::nullopt;
};

/// Accumulates the rows of steady walking.
class TrackingAccumulator {
 public:
  /// A command begins: what comes next belongs to no stride, no standing before.
  void BeginCommand() noexcept;
  /// @param dt_s  since the row before. @pre the row has truth and command.
  void AddSteady(const logs::Row& row, double dt_s);
  [[nodiscard]] TrackingErrors Result() const noexcept;

 private:
  struct MeanSquare {
    double sum = 0.0;
    long count = 0;
    void Add(double error) noexcept;
    [[nodiscard]] std::optional<double> Root() const noexcept;
  };
  void AddStanding(const Vec2& p_W) noexcept;
  void AddReference(const logs::Row& row) noexcept;

  TrackingErrors sums_;  // the means: sums as yet
  long rows_ = 0;
  MeanSquare velocity_, height_, roll_, pitch_;
  std::optional<Vec2> stand_W_;  // where steady standing began
  StrideMean stride_;            // of the velocity's error
};

}  // namespace scoria::analysis
