// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/field/field_rows.h"
#include "analysis/field/trajectory_error.h"
#include "analysis/field/truth_alignment.h"
#include "analysis/metrics/signal_distributions.h"
#include "analysis/study/field_log.h"
#include "app/analyze/labels.h"
#include "app/analyze/walk_parts.h"
#include "logs/mapping/any_rows.h"

namespace scoria::app {

/// How logs are analysed.
struct AnalyzeOptions {
  std::string robot;                             // see FindRobot
  std::optional<double> mass_kg = std::nullopt;  // of the whole robot; none: the robot's own
  double gravity_mps2 = 9.81;
  logs::RowsOptions rows;
  std::vector<std::string> accept = {};  // kinds of findings
  std::vector<LabelEntry> labels = {};
};

/// One log, analysed.
struct LogAnalysis {
  analysis::FieldLog log;
  analysis::SignalDistributions signals;
  std::vector<WalkParts::Part> parts;
  std::optional<double> cpu_power_W = std::nullopt;  // mean
  /// Of a truth of markers. Where it is found, all that is computed with the truth is so of the
  /// trunk's, in time.
  std::optional<analysis::TruthAlignmentResult> truth_alignment = std::nullopt;
  /// Of the log's estimate; none where the log has no truth.
  std::optional<analysis::TrajectoryError> trajectory_error = std::nullopt;
};

/// @param files  one path, or several CSV files on one clock.
/// @param id     names the log in tables.
/// @param hint   of the robot, see FindRobot.
/// Errors: as LogRows, FindRobot and Accept; std::runtime_error for a log without rows.
[[nodiscard]] LogAnalysis AnalyzeLog(const std::vector<std::filesystem::path>& files,
                                     const std::string& id, const std::string& hint,
                                     const AnalyzeOptions& options);

}  // namespace scoria::app
