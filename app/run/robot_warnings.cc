// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/robot_warnings.h"

#include <cmath>

#include <fmt/format.h>

#include "core/robot_files/inspect.h"

namespace scoria::app {

WalkConditions ConditionsOf(const Scenario& scenario, const core::RobotDescription& robot) {
  WalkConditions conditions;
  conditions.gravity_mps2 = scenario.gravity_mps2;
  conditions.f_max_N = scenario.controller.mpc.f_max_N;
  const auto* sensors = std::get_if<sim::RealisticSensors>(&scenario.sensors);
  if (sensors == nullptr) return conditions;
  conditions.torque_error_Nm = std::hypot(sensors->torque.offset_Nm, sensors->torque.noise_Nm);
  if (!robot.config.has_foot_sensors) return conditions;
  const sim::FootForceParams& feet = sensors->foot_force;
  const double zero_counts = 0.5 * (feet.zero_min + feet.zero_max);
  conditions.foot_threshold_N =
      feet.dead_band_N +
      (controller::FootSensorParams{}.initial_threshold_counts - zero_counts) / feet.gain_per_N;
  return conditions;
}

std::vector<std::string> TareWarnings(const Scenario& scenario) {
  const auto* adapter = std::get_if<controller::KfPlusParams>(&scenario.controller.adaptation);
  if (adapter == nullptr || !adapter->tare.enabled) return {};
  const double end_s = adapter->start_s + adapter->tare.duration_s;
  std::vector<std::string> out;
  for (std::size_t i = 0; i < scenario.payloads.size(); ++i) {
    const sim::PayloadEvent& event = scenario.payloads[i];
    if (event.action != sim::PayloadAction::kAdd || !event.at_s || *event.at_s >= end_s) continue;
    out.push_back(fmt::format(
        "payloads[{}].at_s: {:g} s is within the first {:g} s of walking, in which the robot is "
        "tared (controller.adaptation.start_s and tare.duration_s): part of {:g} kg will count as "
        "the robot's own for good",
        i, *event.at_s, end_s, event.body ? event.body->mass_kg : 0.0));
  }
  return out;
}

std::vector<std::string> WalkWarnings(const core::RobotDescription& robot,
                                      const WalkConditions& conditions) {
  std::vector<std::string> out = core::FindModelWarnings(robot);
  for (WalkFinding& finding : JudgeRobot(robot, conditions)) {
    if (finding.grade != WalkGrade::kMet) out.push_back(std::move(finding.text));
  }
  return out;
}

}  // namespace scoria::app
