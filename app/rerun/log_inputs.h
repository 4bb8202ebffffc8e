// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/field/truth_alignment.h"
#include "controller/controller.h"
#include "core/robot/description.h"
#include "logs/mapping/any_rows.h"

namespace scoria::app {

/// Which log estimation runs on again, and how it is read.
struct LogInputOptions {
  std::filesystem::path log;
  std::optional<std::filesystem::path> robot = std::nullopt;  // YAML; none: the log's own robot, or
                                                              // its mapping's
  logs::RowsOptions rows = {};
};

/// Calls on_row with what the sensors of a log said, and what else it knows of the instant: rows of
/// any origin. Where scoria kept what its controller received, rows come at every physics step, and
/// those between the log's own rows have the group `measured` alone.
/// Errors: as logs::ForEachRow.
logs::RowsReport ForEachInputRow(const LogInputOptions& options,
                                 const std::function<void(const logs::Row&)>& on_row);

/// What a log gives to estimation, by one pass over its rows.
struct LogInputs {
  core::RobotDescription robot;             // without foot sensors if the log has none
  std::filesystem::path robot_file = {};    // its YAML; empty: the log holds the robot
  controller::ControllerParams controller;  // the log's, or the defaults for the robot
  double gravity_mps2 = 9.81;
  double period_s = 0.0;  // of the rows: the median
  double first_s = 0.0, last_s = 0.0;
  std::uint64_t rows = 0;
  bool every_step = false;  // scoria's controller inputs: rows between the log's own are not whole
  // What most of the rows hold, those that have more than `measured` as to the rest.
  bool accelerometer = false, gyroscope = false, joints = false, torques = false;
  bool foot_forces = false, plan = false, truth = false, true_contacts = false;
  bool command = false, estimate = false;  // those of the log
  std::string mapping;                     // its name; empty: rows of scoria's
  bool truth_is_of_markers = false;        // and their place on the trunk is not known
  /// Delay and lever arm of a truth of markers.
  std::optional<analysis::TruthAlignmentResult> alignment = std::nullopt;
  std::string problem;  // what is wrong with the log, in words
};

/// As above, a truth of markers turned into that of the trunk where its alignment is known.
logs::RowsReport ForEachInputRow(const LogInputOptions& options, const LogInputs& inputs,
                                 const std::function<void(const logs::Row&)>& on_row);

/// True for a row of the log's own, which may have every group that the log has.
[[nodiscard]] inline bool IsWhole(const LogInputs& inputs, const logs::Row& row) {
  return !inputs.every_step || row.episode;
}

/// Errors: as logs::ForEachRow; std::runtime_error if there is no robot or the log has no two rows;
/// core::ConfigError for the robot's file.
[[nodiscard]] LogInputs SurveyInputs(const LogInputOptions& options);

/// The controller of a log with keys changed, and what of it the log cannot feed.
struct VariantSetup {
  controller::ControllerParams params;
  std::vector<std::string> remarks;  // what is off and why, in words
};

/// @param set  as "controller.estimator.type=linear_kf".
/// Errors: core::ConfigError for a key or a value; std::runtime_error if the estimator needs what
/// the log has not.
[[nodiscard]] VariantSetup SetUpVariant(const LogInputs& inputs,
                                        const std::vector<std::string>& set);

}  // namespace scoria::app
