// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/robot/description.h"

namespace scoria::app {

/// What a robot meets when it walks; numbers, so that scenarios and defaults give them alike.
struct WalkConditions {
  double gravity_mps2 = 9.81;
  double speed_mps = 0.5;
  double f_max_N = 0.0;  // per foot, of the MPC
  // Standard deviation of a joint's torque by its sensor, offset and noise; absent: none is needed.
  std::optional<double> torque_error_Nm;
  // From which a foot sensor counts as loaded at first; absent: there is none.
  std::optional<double> foot_threshold_N;
};

enum class WalkTopic { kTorque, kReach, kSpeed, kForce, kSensing };
constexpr std::array<std::pair<WalkTopic, std::string_view>, 5> EnumNames(WalkTopic) {
  return {{{WalkTopic::kTorque, "torque"},
           {WalkTopic::kReach, "reach"},
           {WalkTopic::kSpeed, "speed"},
           {WalkTopic::kForce, "force"},
           {WalkTopic::kSensing, "sensing"}}};
}

/// Met; met without the spare that walking needs on rough ground or in real noise; not met, so that
/// the robot cannot walk.
enum class WalkGrade { kMet, kScarce, kNotMet };

struct WalkFinding {
  WalkTopic topic = WalkTopic::kTorque;
  WalkGrade grade = WalkGrade::kMet;
  std::string text;  // numbers, and what to set where the grade is not kMet
};

/// Whether a robot can walk by what its files say, topic by topic:
///   torque   every joint within its limit, standing still on two legs of a trot;
///   reach    feet at their places in standing, at the ends of the stance and lifted;
///   speed    joints within their speed limits while a foot swings at `speed_mps`;
///   force    two feet may carry the weight;
///   sensing  a loaded foot stands out from the errors of what senses it.
/// Statics and kinematics only: a robot that passes may still fall.
[[nodiscard]] std::vector<WalkFinding> JudgeRobot(const core::RobotDescription& robot,
                                                  const WalkConditions& conditions);

/// One sentence over all findings.
[[nodiscard]] std::string Verdict(const std::vector<WalkFinding>& findings);

}  // namespace scoria::app
