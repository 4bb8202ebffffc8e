// SPDX-License-Identifier: BSD-3-Clause
#include "app/analyze/experiment.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include <fmt/format.h>

#include "core/config/node.h"
#include "core/files.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

bool HasExtension(const fs::path& file, std::initializer_list<std::string_view> extensions) {
  const std::string extension = file.extension().string();
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

bool IsLogFile(const fs::path& file) {
  return fs::is_regular_file(file) &&
         (HasExtension(file, {".mcap", ".db3"}) || file.string().ends_with(".db3.zstd"));
}

std::vector<fs::path> EntriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// A folder that rosbag2 wrote: its files are one log.
bool IsBag(const fs::path& folder) {
  if (fs::exists(folder / "metadata.yaml")) return true;
  const std::vector<fs::path> entries = EntriesOf(folder);
  return std::any_of(entries.begin(), entries.end(), [](const fs::path& file) {
    return IsLogFile(file) && !HasExtension(file, {".mcap"});
  });
}

/// Tables on one clock, which are one log.
bool HoldsTables(const fs::path& folder) {
  const std::vector<fs::path> entries = EntriesOf(folder);
  return std::any_of(entries.begin(), entries.end(),
                     [](const fs::path& file) { return HasExtension(file, {".csv"}); });
}

/// Logs within an experiment folder.
std::vector<fs::path> LogsIn(const fs::path& folder) {
  std::vector<fs::path> logs;
  for (const fs::path& entry : EntriesOf(folder)) {
    if (IsLogFile(entry)) logs.push_back(entry);
    if (!fs::is_directory(entry)) continue;
    if (IsBag(entry)) {
      logs.push_back(entry);
    } else {
      const std::vector<fs::path> inner = LogsIn(entry);
      logs.insert(logs.end(), inner.begin(), inner.end());
    }
  }
  return logs;
}

/// The value of a key anywhere below a node; empty if it is not there.
std::string FindScalar(const core::ConfigNode& node, std::string_view key) {
  for (const core::ConfigNode::Entry& entry : node.entries) {
    if (entry.key == key && entry.value.kind == core::ConfigNode::Kind::kScalar)
      return entry.value.scalar;
    if (std::string found = FindScalar(entry.value, key); !found.empty()) return found;
  }
  return "";
}

/// The robot by the name of its URDF, as the reference framework names them.
std::string RobotOfUrdf(const std::string& urdf) {
  const std::string file = fs::path(urdf).filename().string();
  if (file.find("go2") != std::string::npos) return "go2";
  if (file == "quad.urdf" || urdf.find("ulab") != std::string::npos) return "b12";
  return "";
}

/// Fills in what the files beside the bags tell.
void ReadSurroundings(const fs::path& folder, LogEntry& log) {
  if (const fs::path hash = folder / "git-hash.txt"; fs::exists(hash)) {
    std::string text = core::ReadText(hash);
    text.erase(std::find_if(text.begin(), text.end(), [](char c) { return c == '\n'; }),
               text.end());
    log.remarks.push_back(fmt::format("recorded by revision {}", text));
  }
  if (!fs::is_directory(folder / "param-files")) return;
  for (const fs::path& file : EntriesOf(folder / "param-files")) {
    if (!HasExtension(file, {".yaml"})) continue;
    try {
      const core::ConfigNode node = core::LoadConfig(file);
      const std::string urdf = FindScalar(node, "model_urdf");
      if (log.robot_hint.empty()) log.robot_hint = RobotOfUrdf(urdf);
      const std::string sequencer = FindScalar(node, "gait_sequencer");
      if (!sequencer.empty())
        log.remarks.push_back(fmt::format("gait sequencer by its parameters: {}", sequencer));
    } catch (const core::ConfigError& e) {
      log.remarks.emplace_back(e.what());
    }
  }
}

std::vector<LogEntry> ListExperiment(const fs::path& folder) {
  std::vector<LogEntry> logs;
  for (const fs::path& file : LogsIn(folder)) {
    LogEntry log{fs::relative(file, folder).string(), {file}, "", {}};
    ReadSurroundings(folder, log);
    logs.push_back(std::move(log));
  }
  if (logs.empty())
    throw std::runtime_error(fmt::format(
        "{}: holds no log: neither a bag (.mcap, .db3) nor a folder with one", folder.string()));
  return logs;
}

std::string IdOf(const fs::path& file) {
  const fs::path whole = fs::absolute(file).lexically_normal();
  const fs::path named = whole.has_filename() ? whole : whole.parent_path();
  return named.stem() == "log" ? named.parent_path().filename().string() : named.stem().string();
}

/// Equal names get numbers.
void MakeUnique(std::vector<LogEntry>& logs) {
  std::map<std::string, int> seen;
  for (LogEntry& log : logs) {
    if (const int number = ++seen[log.id]; number > 1) log.id += fmt::format("-{}", number);
  }
}

}  // namespace

std::vector<LogEntry> ListLogs(const std::vector<fs::path>& paths) {
  std::vector<LogEntry> logs;
  LogEntry tables;
  for (const fs::path& path : paths) {
    const bool is_folder = fs::is_directory(path) && !IsBag(path);
    if (is_folder && !(LogsIn(path).empty() && HoldsTables(path))) {
      std::vector<LogEntry> more = ListExperiment(path);
      logs.insert(logs.end(), more.begin(), more.end());
    } else if (HasExtension(path, {".csv"})) {
      tables.files.push_back(path);
    } else {
      logs.push_back({IdOf(path), {path}, "", {}});
    }
  }
  if (!tables.files.empty()) {
    tables.id = IdOf(tables.files.front());
    logs.push_back(std::move(tables));
  }
  MakeUnique(logs);
  return logs;
}

}  // namespace scoria::app
