// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "app/scenario/scenario.h"

namespace scoria::app {

/// Every file that an episode reads besides its scenario, with the hash of its content in
/// hexadecimal, or "missing".
using InputHashes = std::map<std::string, std::string>;

/// Finds and hashes the files that episodes read: URDF, meshes, heightmap. (Robot and terrain YAML
/// and their bases are part of the effective scenario.) Each file is read once: a fresh object sees
/// what has changed since.
class InputHasher {
 public:
  [[nodiscard]] InputHashes Hash(const Scenario& scenario);

 private:
  const std::string& HashOf(const std::filesystem::path& file);
  const std::set<std::filesystem::path>& MeshesOf(const core::RobotConfig& config);

  std::map<std::filesystem::path, std::string> hashes_;
  std::map<std::filesystem::path, std::set<std::filesystem::path>> meshes_;  // by URDF
};

/// How the files differ, in words, as "robot.urdf has changed"; empty if they do not.
[[nodiscard]] std::string DescribeChange(const InputHashes& before, const InputHashes& now);

}  // namespace scoria::app
