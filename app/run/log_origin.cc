// SPDX-License-Identifier: BSD-3-Clause
#include "app/run/log_origin.h"

#include <charconv>
#include <cstdlib>
#include <stdexcept>

#include <nlohmann/json.hpp>
#include <unistd.h>
#include <zstd.h>

#include "core/files.h"
#include "core/hash.h"
#include "core/robot_files/load.h"
#include "core/robot_files/mesh_records.h"
#include "logs/format/open_log.h"
#include "terrains/generator.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kHeightmapAttachment = "heightmap.zst";

std::string ToHex(std::uint64_t value) { return fmt::format("{:016x}", value); }

std::uint64_t FromHex(const std::string& text) {
  std::uint64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  if (error != std::errc{} || stop != text.data() + text.size())
    throw std::runtime_error(fmt::format("\"{}\" is no hash", text));
  return value;
}

/// Of all entries but itself.
std::string Checksum(const logs::LogMetadata& metadata) {
  core::Hash64 hash;
  for (const auto& [key, value] : metadata) {
    if (key != "checksum")
      hash.Add(fmt::format("{} {} {}\n{}", key.size(), value.size(), key, value));
  }
  return ToHex(hash.value());
}

json ToJson(const core::MeshRecords& meshes) {
  json all = json::object();
  for (const auto& [name, mesh] : meshes) {
    const auto list = [](const Vec3& v) { return json{v.x(), v.y(), v.z()}; };
    all[name] = {{"low_m", list(mesh.bounds.low)},
                 {"high_m", list(mesh.bounds.high)},
                 {"hash", ToHex(mesh.hash)},
                 {"hull_m", json::array()}};
    for (const Vec3& p : mesh.hull) all[name]["hull_m"].push_back(list(p));
  }
  return all;
}

core::MeshRecords MeshesFromJson(const json& all) {
  core::MeshRecords meshes;
  for (const auto& [name, mesh] : all.items()) {
    const auto vector = [](const json& value) {
      const auto list = value.get<std::array<double, 3>>();
      return Vec3(list[0], list[1], list[2]);
    };
    core::MeshRecord& record = meshes[name];
    record = {{vector(mesh.at("low_m")), vector(mesh.at("high_m"))}, FromHex(mesh.at("hash")), {}};
    if (!mesh.contains("hull_m")) continue;
    for (const json& p : mesh.at("hull_m")) record.hull.push_back(vector(p));
  }
  return meshes;
}

/// The scenario's metadata record.
logs::LogMetadata ReadScenarioRecord(const fs::path& log) {
  const std::unique_ptr<logs::LogSource> source = logs::OpenLog(log);
  const auto& all = source->contents().metadata;
  const auto found = all.find(kScenarioMetadata);
  if (found == all.end() || !found->second.contains("scenario") ||
      !found->second.contains("urdf")) {
    throw std::runtime_error(fmt::format(
        "{}: {}", log.string(),
        logs::LosesData(source->problems())
            ? "is cut off or damaged before its scenario; nothing of it can be re-run or drawn"
            : "holds no scenario; only logs that scoria wrote can be re-run or drawn"));
  }
  const auto checksum = found->second.find("checksum");  // none in logs of version 0.1.0
  if (checksum != found->second.end() && checksum->second != Checksum(found->second))
    throw std::runtime_error(
        fmt::format("{}: the record of its scenario is damaged", log.string()));
  return found->second;
}

/// A file that lives as long as this.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& extension, std::string_view content) {
    std::string pattern = (fs::temp_directory_path() / ("scoria_XXXXXX" + extension)).string();
    const int file = mkstemps(pattern.data(), static_cast<int>(extension.size()));
    if (file < 0) throw core::FileError(pattern, "cannot create", errno);
    close(file);
    path_ = pattern;
    core::WriteText(path_, content);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string Unpack(const logs::Bytes& packed) {
  const std::uint64_t size = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (size > kLargestHeightmap) throw std::runtime_error("does not decompress");
  std::string content(static_cast<std::size_t>(size), '\0');
  const std::size_t n =
      ZSTD_decompress(content.data(), content.size(), packed.data(), packed.size());
  if (ZSTD_isError(n) != 0 || n != content.size()) throw std::runtime_error("does not decompress");
  return content;
}

/// What a log that holds only the heightmap's hash needs.
void CheckHeightmapFile(const LogOrigin& origin) {
  const fs::path& file = origin.scenario.terrain.heightmap.file;
  const auto hash = core::HashFile(file);
  if (hash == origin.heightmap_hash) return;
  throw std::runtime_error(fmt::format(
      "{}: its ground {} {}, and the log holds only the hash of it", origin.log.string(),
      file.string(), hash ? "has changed since the walk" : "cannot be read"));
}

}  // namespace

LogOrigin ReadLogOrigin(const fs::path& log, const std::vector<std::string>& overrides) {
  const logs::LogMetadata record = ReadScenarioRecord(log);
  core::ConfigNode node = core::ParseConfig(record.at("scenario"), log.string());
  for (const std::string& assignment : overrides) core::ApplyOverride(node, assignment);
  LogOrigin origin{log, {}, record.at("urdf"), {}, {}};
  try {
    if (record.contains("meshes")) origin.meshes = MeshesFromJson(json::parse(record.at("meshes")));
    if (record.contains("heightmap_hash"))
      origin.heightmap_hash = FromHex(record.at("heightmap_hash"));
  } catch (const std::exception& e) {
    throw std::runtime_error(
        fmt::format("{}: the record of its scenario is damaged: {}", log.string(), e.what()));
  }
  const core::RobotDescription robot =
      core::MakeRobot(ReadRobotSection(node), origin.urdf_text, origin.meshes);
  origin.scenario = ReadScenario(node, robot.similarity);
  return origin;
}

core::RobotDescription RobotOf(const LogOrigin& origin) {
  return core::MakeRobot(origin.scenario.robot, origin.urdf_text, origin.meshes);
}

terrains::Heightfield GroundOf(const LogOrigin& origin) {
  terrains::TerrainParams params = origin.scenario.terrain;
  if (!origin.heightmap_hash) return terrains::GenerateTerrain(params, origin.scenario.seed, 0);
  const auto packed = logs::OpenLog(origin.log)->ReadAttachment(kHeightmapAttachment);
  if (!packed) {
    CheckHeightmapFile(origin);
    return terrains::GenerateTerrain(params, origin.scenario.seed, 0);
  }
  const std::string content = Unpack(packed->data);
  core::Hash64 hash;
  hash.Add(content);
  if (hash.value() != *origin.heightmap_hash)
    throw std::runtime_error(fmt::format("{}: its ground is damaged", origin.log.string()));
  const TemporaryFile file(params.heightmap.file.extension().string(), content);
  params.heightmap.file = file.path();
  return terrains::GenerateTerrain(params, origin.scenario.seed, 0);
}

logs::LogMetadata MakeLogMetadata(const Scenario& scenario, const core::RobotDescription& robot,
                                  const logs::LogMetadata& extra) {
  logs::LogMetadata metadata = extra;
  metadata["scenario"] = EffectiveYaml(scenario);
  metadata["engine"] = sim::EngineName(scenario.physics.engine);
  metadata["urdf"] = robot.urdf_text;
  metadata["meshes"] =
      ToJson(core::RecordMeshes(robot)).dump(-1, ' ', false, json::error_handler_t::replace);
  const fs::path& heightmap = scenario.terrain.heightmap.file;
  if (!heightmap.empty()) {
    if (const auto hash = core::HashFile(heightmap)) metadata["heightmap_hash"] = ToHex(*hash);
  }
  metadata["contact_force_frame"] = "W";
  metadata["checksum"] = Checksum(metadata);
  return metadata;
}

std::optional<logs::LogAttachment> PackHeightmap(const Scenario& scenario) {
  const fs::path& file = scenario.terrain.heightmap.file;
  std::error_code error;
  if (file.empty() || fs::file_size(file, error) > kLargestHeightmap) return std::nullopt;
  const std::string content = core::ReadText(file);
  constexpr int kLevel = 9;  // once per log
  logs::LogAttachment attachment{kHeightmapAttachment, "application/zstd",
                                 logs::Bytes(ZSTD_compressBound(content.size()))};
  const std::size_t n = ZSTD_compress(attachment.data.data(), attachment.data.size(),
                                      content.data(), content.size(), kLevel);
  if (ZSTD_isError(n) != 0 || n > kLargestPackedHeightmap) return std::nullopt;
  attachment.data.resize(n);
  return attachment;
}

}  // namespace scoria::app
