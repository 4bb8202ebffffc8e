// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/study/design.h"
#include "analysis/study/field_log.h"
#include "analysis/study/stopping.h"
#include "terrains/generator.h"

namespace scoria::analysis {

/// The metric that is tested as counts.
inline constexpr std::string_view kFallsKey = "falls";

/// One episode as its folder tells it.
struct EpisodeRecord {
  std::string id, arm, end, message;
  std::string engine;              // that moved the robot; empty: older results, logs of robots
  std::vector<std::string> point;  // value of each swept key
  std::uint64_t seed = 0;
  bool has_metrics = false;  // false for a crashed worker or a missing result
  double walked_m = 0.0;
  std::map<std::string, double> us_per_step;      // wall clock by stage
  std::map<std::string, std::uint64_t> counters;  // what did not go to plan, by name
  std::map<std::string, std::uint64_t> events;    // how many of each kind
  std::string state_hash;                         // of the whole walk, in hexadecimal
  terrains::TerrainStatistics terrain;
  EpisodeMetrics metrics;
  std::string ground;       // equal where episodes walked the same one
  std::vector<Vec2> route;  // the operator's, m; empty without one
  std::filesystem::path folder;
};

struct Axis {
  std::string key, label;
  std::vector<std::string> values;
  std::string baseline;  // value that the others are compared with; empty: none
  [[nodiscard]] bool IsNumeric() const;
};

/// A campaign's folder, or a single run's as a campaign of one.
struct CampaignResults {
  std::string name;
  std::vector<std::string> arms;
  std::vector<Axis> axes;
  std::optional<Design> design;  // in place of axes: points of episodes are of it
  std::vector<EpisodeRecord> episodes;
  std::optional<StopRecord> stop;  // of a campaign that may stop by itself
  bool single_run = false;
  std::vector<FieldLog> logs;  // of robots, of which the episodes are parts; none of simulations
};

/// What an episode's folder holds; a result that is missing or cannot be read is one without
/// metrics.
/// @param index  id, arm, point and seed.
[[nodiscard]] EpisodeRecord LoadEpisode(const std::filesystem::path& folder, EpisodeRecord index);

/// Errors: std::runtime_error that names the file and what is missing.
[[nodiscard]] CampaignResults LoadResults(const std::filesystem::path& folder);

/// All combinations of the axes' values, in order.
[[nodiscard]] std::vector<std::vector<std::string>> AllPoints(const std::vector<Axis>& axes);

}  // namespace scoria::analysis
