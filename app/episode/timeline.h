// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "app/scenario/scenario.h"
#include "core/event_clock.h"

namespace scoria::app {

/// The pushes of a scenario.
class Pushes {
 public:
  explicit Pushes(const std::vector<Push>& pushes) : pushes_(pushes), started_(pushes.size()) {}

  /// Starts those whose time has come.
  /// @param yaw_rad the robot's heading, by which a push that starts now is directed.
  /// @returns the pushes that started.
  std::vector<Push> Update(const core::EventClock& now, double yaw_rad);
  /// Sum of those that last, N.
  [[nodiscard]] Vec3 ForceAt(const core::EventClock& now) const;

 private:
  struct Started {
    core::EventTimer timer;
    Vec3 f_W = Vec3::Zero();
  };
  std::vector<Push> pushes_;
  std::vector<Started> started_;
};

/// The controller's parameters over the scenario's changes. A change stays: after a fall the
/// controller starts with it.
class ControllerChanges {
 public:
  /// Errors: core::ConfigError.
  explicit ControllerChanges(const Scenario& scenario);

  /// Makes at most one change, so that each is told on its own; call again until nothing is
  /// returned. @returns the change that was made.
  [[nodiscard]] const ControllerChange* Next(const core::EventClock& now);
  /// Holds until the next change.
  void Override(const controller::ControllerParams& params) { override_ = params; }
  [[nodiscard]] const controller::ControllerParams& in_force() const {
    return override_ ? *override_ : made_ == 0 ? first_ : after_[made_ - 1];
  }

 private:
  controller::ControllerParams first_;
  std::vector<ControllerChange> changes_;
  std::vector<controller::ControllerParams> after_;  // each change
  std::vector<core::EventTimer> timers_;
  std::size_t made_ = 0;
  std::optional<controller::ControllerParams> override_;
};

}  // namespace scoria::app
