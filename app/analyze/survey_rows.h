// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/field/joint_speed.h"
#include "app/analyze/log_rows.h"
#include "core/robot/description.h"
#include "logs/interval_histogram.h"
#include "logs/quality/finding.h"

namespace scoria::app {

/// What the first pass over a log's rows tells.
struct RowsSurvey {
  std::vector<logs::Finding> findings;  // of the messages, too; worst first
  logs::RowsReport report;
  std::uint64_t rows = 0;
  double first_s = 0.0, last_s = 0.0, median_step_s = 0.0;
  logs::RowGroups groups;                           // that any row has
  std::uint64_t with_truth = 0;                     // rows
  std::uint64_t with_motion = 0;                    // rows with joint angles, rate and acceleration
  bool has_foot_forces = false;                     // as the log estimates them, in any row
  bool has_torque = false, has_speed = false;       // of the joints, in any row
  std::optional<double> speed_lag_s, torque_lag_s;  // see analysis::JointDelays
};

/// @param robot  borrowed; null: not known.
/// Errors: as LogRows::ForEach.
[[nodiscard]] RowsSurvey SurveyRows(const LogRows& rows, const core::RobotDescription* robot,
                                    double gravity_mps2);

}  // namespace scoria::app
