// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "core/robot/description.h"

namespace scoria::core {

/// Every mesh file that the robot's shapes name.
[[nodiscard]] std::set<std::filesystem::path> MeshFiles(const RobotDescription& robot);

/// Box and content of every mesh that can be read, for a log.
[[nodiscard]] MeshRecords RecordMeshes(const RobotDescription& robot);

/// Of a robot from a log: meshes that are gone, or are not what the log was recorded with, are
/// drawn as the boxes around them. @returns a remark for each such file.
std::vector<std::string> DrawLostMeshesAsBoxes(RobotDescription& robot);

}  // namespace scoria::core
