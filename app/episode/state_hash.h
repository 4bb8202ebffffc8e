// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "core/robot/state.h"

namespace scoria::app {

/// Steps between two updates of an episode's state hash.
inline constexpr int kHashEvery = 100;

/// A hash of the robot's state and of every hash before it, so that two episodes with equal hashes
/// went through equal states.
[[nodiscard]] std::uint64_t ChainHash(const RobotState& state, std::uint64_t before);

}  // namespace scoria::app
