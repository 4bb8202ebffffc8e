// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/config/node.h"
#include "core/robot/description.h"

namespace scoria::core {

/// @throws ConfigError that names the robot's URDF, a key or link of it, and the rule.
[[noreturn]] inline void FailUrdf(const RobotConfig& config, const std::string& key,
                                  const std::string& rule) {
  throw ConfigError({config.urdf.string(), 0, 0}, key, rule);
}

}  // namespace scoria::core
