// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "app/episode/step_record.h"
#include "logs/row.h"

namespace scoria::app {

/// The row that analysis sees of a step.
[[nodiscard]] logs::Row MakeRow(const StepRecord& record);

/// What sensing found: estimate, contacts and model of a row.
/// @param used_mass_kg      of the model that the controller acts on.
/// @param has_foot_sensors  of the robot.
void FillSensed(const controller::Sensed& sensed, double used_mass_kg, bool has_foot_sensors,
                logs::Row& row);

/// What the controller says of itself, in a row: plan, reference, estimate, contacts, model and
/// supervision.
/// @param has_foot_sensors  of the robot.
void FillControl(const controller::ControlOutput& control, bool has_foot_sensors, logs::Row& row);

}  // namespace scoria::app
