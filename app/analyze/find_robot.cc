// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/find_robot.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "app/run/log_origin.h"
#include "app/scenario/config_kinds.h"
#include "app/scenario/scenario.h"
#include "core/text.h"
#include "logs/format/open_log.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// The folder robots, here or beside the program's build folder.
std::vector<fs::path> RobotFolders() {
  const fs::path source =
      fs::read_symlink("/proc/self/exe").parent_path().parent_path().parent_path().parent_path();
  return {fs::path("robots"), source / "robots"};
}

std::vector<std::string> RobotNames() {
  std::vector<std::string> names;
  for (const fs::path& folder : RobotFolders()) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const std::string name = entry.path().filename().string();
      const bool is_robot = fs::exists(entry.path() / (name + ".yaml"));
      if (is_robot && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }
  }
  return names;
}

/// The file itself, or robots/NAME/NAME.yaml; empty if there is none.
fs::path FileOf(const std::string& name_or_file) {
  if (fs::is_regular_file(name_or_file)) return name_or_file;
  for (const fs::path& folder : RobotFolders()) {
    fs::path file = folder / name_or_file / (name_or_file + ".yaml");
    if (fs::is_regular_file(file)) return file;
  }
  return {};
}

std::shared_ptr<const core::RobotDescription> Load(const fs::path& file) {
  return std::make_shared<core::RobotDescription>(ReadScaledRobot(LoadKind("robot", file, {})));
}

bool IsOurs(const fs::path& log) {
  return logs::OpenLog(log)->contents().metadata.contains(kScenarioMetadata);
}

}  // namespace

FoundRobot FindRobot(const std::string& asked_for, const fs::path& log, const fs::path& mapped,
                     const std::string& hint) {
  if (!asked_for.empty()) {
    const fs::path file = FileOf(asked_for);
    if (file.empty())
      throw core::ConfigError({asked_for, 0, 0}, "robot",
                              fmt::format("is neither a file nor a robot of ours{}",
                                          core::DidYouMean(asked_for, RobotNames())));
    return {Load(file), fmt::format("{}, as asked for", file.string())};
  }
  if (IsOurs(log))
    return {std::make_shared<core::RobotDescription>(RobotOf(ReadLogOrigin(log))),
            "the log's own metadata"};
  if (!mapped.empty()) {
    const fs::path file = fs::exists(mapped) ? mapped : FileOf(mapped.stem().string());
    return {Load(file.empty() ? mapped : file), fmt::format("{}, of the mapping", mapped.string())};
  }
  if (!hint.empty()) {
    if (const fs::path file = FileOf(hint); !file.empty())
      return {Load(file), fmt::format("{}, by the experiment's parameters", file.string())};
  }
  return {nullptr, "not known; name it by --robot"};
}

}  // namespace scoria::app
