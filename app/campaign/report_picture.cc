// SPDX-License-Identifier: BSD-3-Clause
#include "app/campaign/report_picture.h"

#include <algorithm>
#include <vector>

#include "analysis/study/results.h"
#include "analysis/video/video.h"
#include "app/run/log_origin.h"
#include "logs/read_rows.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// Logs of episodes with falls first, then those of others, then any other log below the folder.
std::vector<fs::path> LogsOf(const fs::path& folder) {
  std::vector<fs::path> logs, others;
  for (const analysis::EpisodeRecord& e : analysis::LoadResults(folder).episodes) {
    const fs::path log = e.folder / "log.mcap";
    if (fs::exists(log)) (e.metrics.falls.empty() ? others : logs).push_back(log);
  }
  logs.insert(logs.end(), others.begin(), others.end());
  constexpr auto kSkip = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(folder, kSkip)) {
    const bool known = std::find(logs.begin(), logs.end(), entry.path()) != logs.end();
    if (entry.path().filename() == "log.mcap" && !known) logs.push_back(entry.path());
  }
  return logs;
}

/// The rows up to a fall, or up to the middle of the walk.
analysis::ReportPicture Draw(const fs::path& log, const logs::LogContent& content) {
  const LogOrigin origin = ReadLogOrigin(log);
  const core::RobotDescription robot = RobotOf(origin);
  const terrains::Heightfield ground = GroundOf(origin);
  const auto& rows = content.rows;
  const bool fell = !content.falls_s.empty();
  const double until_s =
      fell ? content.falls_s.front() : 0.5 * (rows.front().time_s + rows.back().time_s);
  const auto end = std::find_if(rows.begin(), rows.end(),
                                [&](const logs::Row& r) { return r.time_s > until_s; });
  analysis::VideoOptions options;
  options.width_px = 720;
  options.height_px = 480;
  options.title = origin.scenario.name;
  const std::string jpeg = analysis::RenderStill({rows.begin(), end}, robot, ground, options);
  const std::string episode = log.parent_path().filename().string();
  return {jpeg, fmt::format("{} of {}, at {:.1f} s.", fell ? "The first fall" : "The walk", episode,
                            until_s)};
}

std::optional<analysis::ReportPicture> TryToDraw(const fs::path& log) {
  try {
    logs::LogContent content = logs::ReadLog(log);
    std::erase_if(content.rows, [](const logs::Row& r) { return !analysis::CanDraw(r); });
    if (!content.rows.empty()) return Draw(log, content);
  } catch (const std::exception&) {
    // Another log may do.
  }
  return std::nullopt;
}

}  // namespace

std::optional<analysis::ReportPicture> MakeReportPicture(const fs::path& folder) {
  constexpr std::size_t kTries = 3;  // a machine without OpenGL has no picture of any log
  try {
    std::vector<fs::path> logs = LogsOf(folder);
    logs.resize(std::min(logs.size(), kTries));
    for (const fs::path& log : logs) {
      if (auto picture = TryToDraw(log)) return picture;
    }
  } catch (const std::exception&) {
    // A picture less is no reason to lose the report.
  }
  return std::nullopt;
}

}  // namespace scoria::app
