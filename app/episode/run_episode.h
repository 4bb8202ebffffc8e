// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <vector>

#include "app/episode/episode.h"

namespace scoria::app {

/// Walks one episode to its end: sensors -> controller -> actuation -> plant, every physics step.
/// @param observers    borrowed. @param interrupted  ends the episode once it is true; borrowed.
[[nodiscard]] EpisodeResult RunEpisode(const Scenario& scenario,
                                       const core::RobotDescription& robot,
                                       const terrains::Heightfield& ground,
                                       const std::vector<EpisodeObserver*>& observers = {},
                                       const std::atomic<bool>* interrupted = nullptr);

}  // namespace scoria::app
