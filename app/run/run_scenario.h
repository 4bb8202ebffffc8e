// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "analysis/metrics/metrics.h"
#include "app/episode/episode_result.h"
#include "app/scenario/scenario.h"

namespace scoria::app {

/// What an episode leaves in its folder: scenario.yaml (effective), log.mcap (unless only metrics
/// are kept), result.json.
struct EpisodeReport {
  EpisodeResult result;
  analysis::EpisodeMetrics metrics;
  std::map<std::string, int> events;  // how many of each kind
  double simulated_s = 0.0;           // at least one step
  double real_time_factor = 0.0;      // simulated time over wall time, without set-up
  double commanded_m = 0.0;           // horizontal way, three seconds for standing up left out
  std::string failure;                // why this was no walk, in words; empty if it was one
};

struct RunOptions {
  std::filesystem::path folder;
  std::function<void(double time_s, int falls)> on_progress;
  std::function<void(double time_s, const std::string& kind, const std::string& detail)> on_event;
  std::function<void(const std::string& warning)>
      on_warning;  // before the walk: of robot and ground
  const std::atomic<bool>* interrupted = nullptr;
  std::filesystem::path save_qps;  // folder for the solved QPs; empty: none
};

/// Runs one scenario into a folder, which is created; an older run in it is removed first.
/// Errors: core::ConfigError, core::FileError.
EpisodeReport RunToFolder(const Scenario& scenario, const RunOptions& options);

}  // namespace scoria::app
