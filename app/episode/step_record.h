// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "controller/controller.h"
#include "sim/actuation.h"
#include "sim/plant/plant.h"

namespace scoria::app {

/// What an episode knows of one step, borrowed from it until its next step: what the sensors said
/// at its begin, what operator and controller made of it, and the truth of then (for an observer)
/// or of now (Episode::last).
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
  bool has_foot_sensors;
  bool fallen;
  std::uint32_t segment;
  const controller::SolverFaults& faults;  // played on the solvers
  const controller::Controller& controller;
  std::optional<std::uint64_t> state_hash;  // where it was brought up to date in this step
};

}  // namespace scoria::app
