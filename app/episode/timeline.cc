// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/timeline.h"

#include <cmath>

namespace scoria::app {

std::vector<Push> Pushes::Update(const core::EventClock& now, double yaw_rad) {
  std::vector<Push> started;
  for (std::size_t i = 0; i < pushes_.size(); ++i) {
    const Push& push = pushes_[i];
    if (!started_[i].timer.BeginAfter(push.at_s, now)) continue;
    const double azimuth = yaw_rad + push.azimuth_rad;
    started_[i].f_W =
        push.impulse_Ns / push.duration_s * Vec3(std::cos(azimuth), std::sin(azimuth), 0.0);
    started.push_back(push);
  }
  return started;
}

Vec3 Pushes::ForceAt(const core::EventClock& now) const {
  Vec3 f_W = Vec3::Zero();
  for (std::size_t i = 0; i < pushes_.size(); ++i)
    if (started_[i].timer.Runs(pushes_[i].duration_s, now)) f_W += started_[i].f_W;
  return f_W;
}

ControllerChanges::ControllerChanges(const Scenario& scenario)
    : first_(scenario.controller),
      changes_(scenario.controller_changes),
      after_(ChangedControllers(scenario)),
      timers_(changes_.size()) {}

const ControllerChange* ControllerChanges::Next(const core::EventClock& now) {
  if (made_ == changes_.size() || !timers_[made_].BeginAfter(changes_[made_].at_s, now))
    return nullptr;
  override_.reset();
  return &changes_[made_++];
}

}  // namespace scoria::app
