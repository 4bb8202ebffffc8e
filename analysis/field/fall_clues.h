// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <deque>
#include <optional>

#include "analysis/signals/falls.h"
#include "core/robot/description.h"
#include "logs/row.h"

namespace scoria::analysis {

/// What a robot's own log tells of a fall: the tilt by its attitude, the trunk's height over the
/// lowest foot by its joints, and the load that the trunk bears: what the accelerometer says that
/// all of the ground carries, less what the feet do, a mean over kLoad_s. Where the feet's forces
/// are those of the torques alone, statics without the legs' weight, their usual error (the mean
/// over the last kUsual_s) is taken off.
///
/// Two things look like a fall and are none: an attitude that is wrong for a moment, and knees or
/// shanks that touch the ground in place of the feet. So the tilt is the least of the last kTilt_s,
/// unless the gyroscope tells the same turns within kAgrees_rad, and a load is of the trunk only
/// where that is lower than kLow of its nominal height.
class FallClues {
 public:
  static constexpr double kTilt_s = 0.03, kAgrees_rad = 0.1, kLow = 0.6;
  static constexpr double kLoad_s = 0.1, kUsual_s = 10.0;

  /// @param robot    borrowed; null: only the tilt is told.
  /// @param mass_kg  of the whole robot.
  FallClues(const core::RobotDescription* robot, double mass_kg, double gravity_mps2) noexcept
      : robot_(robot), mass_kg_(mass_kg), gravity_mps2_(gravity_mps2) {}

  /// @param dt_s  since the row before.
  [[nodiscard]] FallSample Update(const logs::Row& row, double dt_s);

  /// The robot was placed, or rows are missing.
  void Reset() noexcept {
    load_N_.reset();
    last_R_WB_.reset();
    tilts_.clear();
  }

 private:
  struct Tilt {
    double time_s = 0.0, tilt_rad = 0.0;
    double unexplained_rad = 0.0;  // turn since the row before that the gyroscope does not tell
  };
  [[nodiscard]] double BelievedTilt(const logs::Row& row, const Mat3& R_WB, double dt_s);
  [[nodiscard]] double UnexplainedTurn(const logs::Row& row, const Mat3& R_WB, double dt_s) const;
  [[nodiscard]] std::optional<double> FeetForce(const logs::Row& row, const Mat3& R_WB) const;
  [[nodiscard]] std::optional<double> WithoutUsual(double load_N, double dt_s);

  const core::RobotDescription* robot_;
  double mass_kg_, gravity_mps2_;
  std::deque<Tilt> tilts_;  // of the last kTilt_s
  std::optional<Mat3> last_R_WB_;
  std::optional<double> load_N_;
  double usual_N_ = 0.0, seen_s_ = 0.0;  // of loads by torques
};

}  // namespace scoria::analysis
