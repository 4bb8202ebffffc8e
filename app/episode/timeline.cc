// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/timeline.h"

#include <cmath>

namespace scoria::app {

std::vector<Push> Pushes::Update(double clock_s, double time_s, double yaw_rad) {
  std::vector<Push> started;
  for (std::size_t i = 0; i < pushes_.size(); ++i) {
    const Push& push = pushes_[i];
    if (active_[i] || clock_s <= push.at_s) continue;
    const double azimuth = yaw_rad + push.azimuth_rad;
    active_[i] = {time_s + push.duration_s, push.impulse_Ns / push.duration_s *
                                                Vec3(std::cos(azimuth), std::sin(azimuth), 0.0)};
    started.push_back(push);
  }
  return started;
}

Vec3 Pushes::ForceAt(double time_s) const {
  Vec3 f_W = Vec3::Zero();
  for (const std::optional<Active>& active : active_)
    if (active && time_s < active->until_s) f_W += active->f_W;
  return f_W;
}

ControllerChanges::ControllerChanges(const Scenario& scenario)
    : first_(scenario.controller),
      changes_(scenario.controller_changes),
      after_(ChangedControllers(scenario)) {}

const ControllerChange* ControllerChanges::Next(double clock_s) {
  if (made_ == changes_.size() || clock_s <= changes_[made_].at_s) return nullptr;
  return &changes_[made_++];
}

}  // namespace scoria::app
