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
};

/// A scenario that repeats a log: its robot, its commands over time or the speeds that were walked,
/// its gait, and the terrain preset whose deviogram is nearest to that of the footholds. Says in
/// comments what each is taken from, and what the log does not tell.
/// Errors: as SurveyInputs and SetUpVariant; core::ConfigError for a preset.
[[nodiscard]] std::string DraftScenario(const DraftScenarioOptions& options);

}  // namespace scoria::app
