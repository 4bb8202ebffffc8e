// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "app/inspect/verdict.h"
#include "app/scenario/scenario.h"
#include "core/robot/description.h"

namespace scoria::app {

/// What the robot meets in a scenario.
[[nodiscard]] WalkConditions ConditionsOf(const Scenario& scenario,
                                          const core::RobotDescription& robot);

/// Payloads that come on while kf_plus still weighs the robot: part of them becomes its tare.
[[nodiscard]] std::vector<std::string> TareWarnings(const Scenario& scenario);

/// What may keep a robot from walking: core::FindModelWarnings, and what JudgeRobot finds scarce or
/// missing. One sentence each.
[[nodiscard]] std::vector<std::string> WalkWarnings(const core::RobotDescription& robot,
                                                    const WalkConditions& conditions);

}  // namespace scoria::app
