// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "analysis/metrics/metrics.h"
#include "app/episode/run_episode.h"
#include "app/scenario/scenario.h"

namespace scoria::test {

/// What an episode ended with, and what its rows say.
struct WalkOutcome {
  app::EpisodeResult result;
  analysis::EpisodeMetrics metrics;
};

/// Walks a scenario on its own ground.
/// @param on_row  sees every row.
[[nodiscard]] WalkOutcome Walk(const app::Scenario& scenario,
                               const std::function<void(const logs::Row&)>& on_row = {});

}  // namespace scoria::test
