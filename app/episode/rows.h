// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/controller.h"
#include "logs/row.h"
#include "sim/actuation.h"
#include "sim/world.h"

namespace scoria::app {

/// What the runner knows after one step; borrowed for the call.
struct StepRecord {
  std::int64_t step;
  double time_s;
  const sim::Truth& truth;
  const SensorFrame& sensors;
  const Command& command;
  const controller::ControlOutput& control;
  const controller::GaitParams& gait;  // in force
  Counters counters;
  const sim::EnergyMeter& energy;
  const sim::BatteryState& battery;
  const LegArray<Vec3>& motor_tau_Nm;
  double ground_z_m;
  bool fallen;
  std::uint32_t segment;
};

/// The row that analysis sees of a step.
[[nodiscard]] logs::LogRow MakeRow(const StepRecord& record);

/// Writes what the controller believes into a row, beside the truth.
void FillEstimate(const controller::ControlOutput& control, const RobotState& truth,
                  logs::LogRow& row);

}  // namespace scoria::app
