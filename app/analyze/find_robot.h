// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/robot/description.h"

namespace scoria::app {

/// A robot, and how it was found.
struct FoundRobot {
  std::shared_ptr<const core::RobotDescription> robot;  // null: not known
  std::string source;                                   // in words
};

/// The robot of a log: the one that is asked for, that of the log's own metadata, the mapping's, or
/// the one that `hint` names.
/// @param asked_for  a robot's YAML, or the name of one of the folder robots; empty: none.
/// @param log        the first file.
/// @param mapped     the mapping's; empty: none.
/// @param hint       as "go2", from the log's surroundings; empty: none.
/// Errors: core::ConfigError for a robot that is asked for or mapped.
[[nodiscard]] FoundRobot FindRobot(const std::string& asked_for, const std::filesystem::path& log,
                                   const std::filesystem::path& mapped, const std::string& hint);

}  // namespace scoria::app
