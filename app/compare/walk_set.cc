// SPDX-License-Identifier: BSD-3-Clause
#include "app/compare/walk_set.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "analysis/study/results.h"
#include "app/analyze/experiment.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// The folder and the arm that "FOLDER:ARM" names; the whole as a folder if there is one.
std::pair<fs::path, std::optional<std::string>> SplitArm(const std::string& path) {
  const std::size_t colon = path.rfind(':');
  if (colon == std::string::npos || fs::exists(path)) return {path, std::nullopt};
  return {path.substr(0, colon), path.substr(colon + 1)};
}

bool HoldsResults(const fs::path& folder) {
  return fs::exists(folder / "result.json") || fs::exists(folder / "campaign.json");
}

void Add(const LogEntry& entry, const AnalyzeOptions& options, WalkSet& set) {
  LogAnalysis analysis = AnalyzeLog(entry.files, entry.id, entry.robot_hint, options);
  set.ids.push_back(entry.id);
  set.walks.push_back({std::move(analysis.log.metrics), std::move(analysis.signals)});
}

/// As it was measured while it walked; signals as its log tells them, if it was kept.
void AddEpisode(const analysis::EpisodeRecord& episode, const AnalyzeOptions& options,
                WalkSet& set) {
  const fs::path log = episode.folder / "log.mcap";
  set.ids.push_back(episode.id);
  set.walks.push_back({episode.metrics, {}});
  if (fs::exists(log))
    set.walks.back().signals = AnalyzeLog({log}, episode.id, {}, options).signals;
}

void AddLogOf(const analysis::EpisodeRecord& episode, const AnalyzeOptions& options, WalkSet& set) {
  const fs::path log = episode.folder / "log.mcap";
  if (!fs::exists(log))
    throw std::runtime_error(
        fmt::format("{}: has no log to compare with logs; walk it with log.keep=full",
                    episode.folder.string()));
  Add({episode.id, {log}, {}, {}}, options, set);
}

WalkSet OfResults(const fs::path& folder, const std::optional<std::string>& arm,
                  const AnalyzeOptions& options, bool by_logs) {
  const analysis::CampaignResults results = analysis::LoadResults(folder);
  if (!arm && results.arms.size() > 1)
    throw std::runtime_error(fmt::format("{}: has the arms {}; name one, as {}:{}", folder.string(),
                                         fmt::join(results.arms, ", "), folder.string(),
                                         results.arms.front()));
  if (arm && std::ranges::find(results.arms, *arm) == results.arms.end())
    throw std::runtime_error(fmt::format("{}: has no arm \"{}\"; there are {}", folder.string(),
                                         *arm, fmt::join(results.arms, ", ")));
  WalkSet set;
  for (const analysis::EpisodeRecord& episode : results.episodes) {
    if (!episode.has_metrics || (arm && episode.arm != *arm)) continue;
    if (by_logs) {
      AddLogOf(episode, options, set);
    } else {
      AddEpisode(episode, options, set);
    }
  }
  return set;
}

/// Folders of logs are searched for logs one below the other.
std::vector<fs::path> LogsIn(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> logs;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    if (entry.path().extension() == ".mcap") logs.push_back(entry.path());
  }
  std::ranges::sort(logs);
  if (logs.empty()) logs.push_back(path);
  return logs;
}

WalkSet OfLogs(const fs::path& path, const AnalyzeOptions& options) {
  WalkSet set;
  for (const LogEntry& entry : ListLogs(LogsIn(path))) Add(entry, options, set);
  return set;
}

}  // namespace

bool IsResults(const std::string& path) { return HoldsResults(SplitArm(path).first); }

WalkSet LoadWalks(const std::string& path, const AnalyzeOptions& options, bool by_logs) {
  const auto [file, arm] = SplitArm(path);
  WalkSet set = HoldsResults(file) ? OfResults(file, arm, options, by_logs) : OfLogs(file, options);
  set.name = path;
  if (set.walks.empty()) throw std::runtime_error(fmt::format("{}: holds no walk", path));
  return set;
}

}  // namespace scoria::app
