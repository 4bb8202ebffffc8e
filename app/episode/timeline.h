// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "app/scenario/scenario.h"

namespace scoria::app {

/// The pushes of a scenario. One starts once, when its clock first reaches it, and lasts its
/// duration in simulated time, whatever becomes of the robot.
class Pushes {
 public:
  explicit Pushes(const std::vector<Push>& pushes) : pushes_(pushes), active_(pushes.size()) {}

  /// Starts those whose time has come.
  /// @param clock_s on which pushes are scheduled. @param time_s simulated.
  /// @param yaw_rad the robot's heading, by which a push that starts now is directed.
  /// @returns the pushes that started.
  std::vector<Push> Update(double clock_s, double time_s, double yaw_rad);
  /// Sum of those that last, N.
  [[nodiscard]] Vec3 ForceAt(double time_s) const;

 private:
  struct Active {
    double until_s;
    Vec3 f_W;
  };
  std::vector<Push> pushes_;
  std::vector<std::optional<Active>> active_;
};

/// The controller's parameters over the scenario's changes. A change stays: after a fall the
/// controller starts with it.
class ControllerChanges {
 public:
  /// Errors: core::ConfigError.
  explicit ControllerChanges(const Scenario& scenario);

  /// Makes at most one change, so that each is told on its own; call again until nothing is
  /// returned. @returns the change that was made.
  [[nodiscard]] const ControllerChange* Next(double clock_s);
  [[nodiscard]] const controller::ControllerParams& in_force() const {
    return made_ == 0 ? first_ : after_[made_ - 1];
  }

 private:
  controller::ControllerParams first_;
  std::vector<ControllerChange> changes_;
  std::vector<controller::ControllerParams> after_;  // each change
  std::size_t made_ = 0;
};

}  // namespace scoria::app
