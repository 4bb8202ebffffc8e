// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/scenario/scenario.h"
#include "core/robot/description.h"
#include "logs/format/log_source.h"
#include "terrains/heightfield.h"

namespace scoria::app {

/// Name of the metadata record that holds the scenario.
inline constexpr const char* kScenarioMetadata = "scoria";

/// A heightmap travels in the log if its file is no larger than the first and packs to no more than
/// the second; else the log holds its hash alone.
inline constexpr std::uint64_t kLargestHeightmap = 64u << 20, kLargestPackedHeightmap = 8u << 20;

/// A log's own account of how it was made.
struct LogOrigin {
  std::filesystem::path log;
  Scenario scenario;
  std::string urdf_text;
  core::MeshRecords meshes;                     // none in logs of version 0.1.0
  std::optional<std::uint64_t> heightmap_hash;  // likewise, and where there is no heightmap
};

/// @param overrides of scenario keys, as "controller.gait.type=sgs".
/// Errors: std::runtime_error if the file is no log of scoria, is cut off too early or damaged;
/// core::ConfigError for an override.
[[nodiscard]] LogOrigin ReadLogOrigin(const std::filesystem::path& log,
                                      const std::vector<std::string>& overrides = {});

/// The robot that walked; its mesh files are not needed.
[[nodiscard]] core::RobotDescription RobotOf(const LogOrigin& origin);

/// The ground that it walked on.
/// Errors: std::runtime_error if the log holds the hash of a heightmap alone and the file is gone
/// or another.
[[nodiscard]] terrains::Heightfield GroundOf(const LogOrigin& origin);

/// What ReadLogOrigin reads: scenario, URDF, meshes, the heightmap's hash, and a checksum of it all
/// with `extra`.
[[nodiscard]] logs::LogMetadata MakeLogMetadata(const Scenario& scenario,
                                                const core::RobotDescription& robot,
                                                const logs::LogMetadata& extra);

/// The scenario's heightmap for a log, if there is one and it is not too large.
[[nodiscard]] std::optional<logs::LogAttachment> PackHeightmap(const Scenario& scenario);

}  // namespace scoria::app
