// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/run_episode.h"

namespace scoria::app {

EpisodeResult RunEpisode(const Scenario& scenario, const core::RobotDescription& robot,
                         const terrains::Heightfield& ground,
                         const std::vector<EpisodeObserver*>& observers,
                         const std::atomic<bool>* interrupted) {
  const auto episode = std::make_unique<Episode>(scenario, robot, ground);
  for (EpisodeObserver* observer : observers) episode->Attach(*observer);
  while (!episode->ended()) {
    if (interrupted != nullptr && interrupted->load()) {
      episode->Interrupt();
    } else {
      episode->Step();
    }
  }
  return episode->Result();
}

}  // namespace scoria::app
