// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "app/run/run_scenario.h"

namespace scoria::app {

/// result.json of an episode, without the inputs' hashes and the terrain's statistics.
[[nodiscard]] nlohmann::json ResultToJson(const EpisodeReport& report, const Scenario& scenario);

}  // namespace scoria::app
