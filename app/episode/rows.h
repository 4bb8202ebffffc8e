// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/episode/step_record.h"
#include "logs/row.h"

namespace scoria::app {

/// The row that analysis sees of a step.
[[nodiscard]] logs::Row MakeRow(const StepRecord& record);

/// What the controller says of itself, in a row: plan, reference, estimate, contacts, model and
/// supervision.
/// @param has_foot_sensors  of the robot.
void FillControl(const controller::ControlOutput& control, bool has_foot_sensors, logs::Row& row);

}  // namespace scoria::app
