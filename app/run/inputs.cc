// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/inputs.h"

#include "core/files.h"
#include "core/robot_files/load.h"
#include "core/robot_files/mesh_records.h"

namespace scoria::app {

InputHashes InputHasher::Hash(const Scenario& scenario) {
  InputHashes hashes;
  const auto add = [&](const std::filesystem::path& file) {
    const std::filesystem::path whole = std::filesystem::absolute(file).lexically_normal();
    hashes[whole.string()] = HashOf(whole);
  };
  add(scenario.robot.urdf);
  for (const std::filesystem::path& mesh : MeshesOf(scenario.robot)) add(mesh);
  if (!scenario.terrain.heightmap.file.empty()) add(scenario.terrain.heightmap.file);
  return hashes;
}

const std::string& InputHasher::HashOf(const std::filesystem::path& file) {
  const auto [at, is_new] = hashes_.try_emplace(file);
  if (is_new) {
    const auto hash = core::HashFile(file);
    at->second = hash ? fmt::format("{:016x}", *hash) : "missing";
  }
  return at->second;
}

const std::set<std::filesystem::path>& InputHasher::MeshesOf(const core::RobotConfig& config) {
  const auto [at, is_new] = meshes_.try_emplace(config.urdf);
  if (!is_new) return at->second;
  try {
    at->second = core::MeshFiles(core::ReadRobot(config));
  } catch (const core::ConfigError&) {
    // A robot that cannot be read has no meshes; the episode says what is wrong with it.
  }
  return at->second;
}

std::string DescribeChange(const InputHashes& before, const InputHashes& now) {
  for (const auto& [file, hash] : now) {
    const auto old = before.find(file);
    if (old == before.end()) return file + " was not read before";
    if (old->second != hash) return file + " has changed";
  }
  for (const auto& [file, hash] : before) {
    if (!now.contains(file)) return file + " is no longer read";
  }
  return "";
}

}  // namespace scoria::app
