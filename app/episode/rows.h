// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/episode/step_record.h"
#include "logs/row.h"

namespace scoria::app {

/// The row that analysis sees of a step.
[[nodiscard]] logs::LogRow MakeRow(const StepRecord& record);

/// Wall-clock times of the solvers in that step.
[[nodiscard]] logs::SolveTimes SolveTimesOf(const controller::ControlOutput& control);

/// Writes what the controller believes into a row, beside the truth.
void FillEstimate(const controller::ControlOutput& control, const RobotState& truth,
                  logs::LogRow& row);

}  // namespace scoria::app
