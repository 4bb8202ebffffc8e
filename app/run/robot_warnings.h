// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "controller/mpc/convex_mpc.h"
#include "core/robot/description.h"

namespace scoria::app {

/// What may keep a robot from walking under these parameters: core::FindModelWarnings, and a weight
/// that two feet may not carry. One sentence each.
[[nodiscard]] std::vector<std::string> WalkWarnings(const core::RobotDescription& robot,
                                                    const controller::MpcParams& mpc,
                                                    double gravity_mps2);

}  // namespace scoria::app
