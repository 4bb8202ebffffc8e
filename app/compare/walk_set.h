// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "analysis/study/set_comparison.h"
#include "app/analyze/analyze_log.h"

namespace scoria::app {

/// Walks that are compared with others.
struct WalkSet {
  std::string name;
  std::vector<std::string> ids;
  std::vector<analysis::ComparedWalk> walks;
};

/// True for the folder of a run or a campaign, with or without an arm.
[[nodiscard]] bool IsResults(const std::string& path);

/// What a path names: a log, a folder of logs or an experiment's, a run, or a campaign (of one arm:
/// an arm of several is named as "FOLDER:ARM").
/// @param by_logs  runs and campaigns bring what their logs tell, as a robot's do, not what was
///                 measured while they walked. Distributions of signals are always the logs'.
/// Errors: as AnalyzeLog and analysis::LoadResults; std::runtime_error for a campaign of several
/// arms, and where there is no walk or no log.
[[nodiscard]] WalkSet LoadWalks(const std::string& path, const AnalyzeOptions& options,
                                bool by_logs);

}  // namespace scoria::app
