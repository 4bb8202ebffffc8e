// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "app/rerun/log_inputs.h"

namespace scoria::app {

struct DraftScenarioOptions {
  LogInputOptions input;
  std::filesystem::path out;                    // paths in the text are relative to its folder
  std::filesystem::path terrains = "terrains";  // folder of the presets to choose from
  std::filesystem::path controllers = "scenarios/controllers";  // base of the controller, by robot
  bool walks = true;  // the draft is walked on several frictions, to read that of the log
};

/// A scenario that repeats a log: its robot, its commands over time or the speeds that were walked,
/// its headings, its gait, the terrain preset whose deviogram is nearest to that of the footholds,
/// and the friction on which the feet of its own walks slide as much as the log's. Says in comments
/// what each is taken from, and what the log does not tell.
/// Errors: as SurveyInputs and SummariseWalk; core::ConfigError for a preset.
[[nodiscard]] std::string DraftScenario(const DraftScenarioOptions& options);

}  // namespace scoria::app
