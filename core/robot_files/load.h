// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/robot/description.h"

namespace scoria::core {

/// Loads the URDF that `config` names, and refuses a robot that could not walk.
/// Errors: ConfigError that names the file and what is missing or wrong.
[[nodiscard]] RobotDescription LoadRobot(const RobotConfig& config);

/// As LoadRobot, but lets joints without effort through, for inspection.
[[nodiscard]] RobotDescription ReadRobot(const RobotConfig& config);

/// The robot of a URDF text (a log carries it): a trunk and four legs of HAA, HFE, KFE, fixed links
/// merged, joints in the canonical joint convention.
/// @param meshes  where the log carries them too; files that are not among them are read.
/// Errors: as ReadRobot.
[[nodiscard]] RobotDescription MakeRobot(const RobotConfig& config, const std::string& urdf_text,
                                         const MeshRecords& meshes = {});

}  // namespace scoria::core
