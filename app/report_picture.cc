// SPDX-License-Identifier: BSD-3-Clause
#include "app/report_picture.h"

#include <algorithm>
#include <vector>

#include "analysis/import.h"
#include "analysis/results.h"
#include "analysis/video/video.h"
#include "app/log_origin.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

/// Logs of episodes with falls first, then those of others, then any other log below the folder.
std::vector<fs::path> LogsOf(const fs::path& folder) {
  std::vector<fs::path> with_falls, others;
  for (const analysis::EpisodeRecord& e : analysis::LoadResults(folder).episodes) {
    const fs::path log = e.folder / "log.mcap";
    if (fs::exists(log)) (e.metrics.falls.empty() ? others : with_falls).push_back(log);
  }
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const bool known =
        std::find(with_falls.begin(), with_falls.end(), entry.path()) != with_falls.end();
    if (entry.path().filename() == "log.mcap" && !known) others.push_back(entry.path());
  }
  with_falls.insert(with_falls.end(), others.begin(), others.end());
  return with_falls;
}

/// The rows up to a fall, or up to the middle of the walk.
analysis::ReportPicture Draw(const fs::path& log, const analysis::LogContent& content) {
  const LogOrigin origin = ReadLogOrigin(log);
  const core::RobotDescription robot = RobotOf(origin);
  const terrains::Heightfield ground = GroundOf(origin);
  const auto& rows = content.rows;
  const bool fell = !content.falls_s.empty();
  const double until_s =
      fell ? content.falls_s.front() : 0.5 * (rows.front().time_s + rows.back().time_s);
  const auto end = std::find_if(rows.begin(), rows.end(),
                                [&](const core::LogRow& r) { return r.time_s > until_s; });
  analysis::VideoOptions options;
  options.width_px = 720;
  options.height_px = 480;
  options.title = origin.scenario.name;
  const std::string jpeg = analysis::RenderStill({rows.begin(), end}, robot, ground, options);
  const std::string episode = log.parent_path().filename().string();
  return {jpeg, fmt::format("{} of {}, at {:.1f} s.", fell ? "The first fall" : "The walk", episode,
                            until_s)};
}

}  // namespace

std::optional<analysis::ReportPicture> MakeReportPicture(const fs::path& folder) {
  for (const fs::path& log : LogsOf(folder)) {
    try {
      const analysis::LogContent content = analysis::ReadLog(log);
      if (!content.rows.empty()) return Draw(log, content);
    } catch (const std::exception&) {
      continue;  // a picture less is no reason to lose the report
    }
  }
  return std::nullopt;
}

}  // namespace scoria::app
