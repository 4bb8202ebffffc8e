// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>

#include "core/robot/whole_body.h"
#include "logs/quality/quality_check.h"
#include "logs/quality/tick_history.h"

namespace scoria::logs {

/// The torque of a single joint against those of the other legs' same joints: by which scales of
/// all twelve torques the forces of the feet move the robot as gyroscope, accelerometer and
/// encoders tell. Six equations of the trunk an instant, twelve unknown scales, least squares. What
/// friction and a wrong mass do to a scale they do to those of the other legs as well.
class TorqueScaleCheck : public QualityCheck {
 public:
  /// From here on, over or under the other legs, it is a warning, and an error.
  static constexpr double kWarning = 1.3, kError = 1.6;

  explicit TorqueScaleCheck(const LogSubject& subject);
  void AddTick(const Tick& tick) override;
  [[nodiscard]] std::vector<Finding> Conclude(const std::vector<Finding>& earlier) const override;

  /// Normal equations of the scales.
  struct Sums {
    Mat12 A = Mat12::Zero();
    Vec12 y = Vec12::Zero();
    double squares = 0.0;  // of y
  };

 private:
  [[nodiscard]] std::optional<Vec6> AccelerationOf(const Tick& before, const Tick& now,
                                                   const Tick& after) const;
  /// Standard error of the logarithm of a joint's own scale.
  [[nodiscard]] std::optional<double> ErrorOf(const Sums& all, Eigen::Index joint) const;
  void AddEquations(const Tick& before, const Tick& now, const Tick& after);

  /// Stretches of half a second go to the groups by turns: how much the result changes without one
  /// of them tells how sure it is (jackknife).
  static constexpr std::size_t kGroups = 12;
  static constexpr std::uint64_t kBlock = 100;  // ticks

  LogSubject subject_;
  std::optional<core::WholeBodyModel> model_;
  TickHistory<5> last_;
  std::array<Sums, kGroups> groups_;
  std::uint64_t ticks_ = 0;
};

}  // namespace scoria::logs
