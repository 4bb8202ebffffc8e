// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <optional>

#include "analysis/report/course_figure.h"
#include "analysis/report/sections/sections.h"
#include "logs/read_rows.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

fs::path LogOf(const EpisodeRecord& e) { return e.folder / "log.mcap"; }

/// A single run's log, and those of episodes with falls.
std::vector<const EpisodeRecord*> WithLogs(const CampaignResults& results) {
  std::vector<const EpisodeRecord*> wanted;
  for (const EpisodeRecord& e : results.episodes) {
    const bool shown = results.single_run || !e.metrics.falls.empty();
    if (shown && fs::exists(LogOf(e))) wanted.push_back(&e);
  }
  return wanted;
}

std::optional<std::string> WhyNoCourse(const ReportInput& input) {
  if (!WithLogs(input.results).empty()) return std::nullopt;
  if (input.results.single_run) return "the run kept no log";
  const auto& episodes = input.results.episodes;
  const bool fell = std::any_of(episodes.begin(), episodes.end(),
                                [](const EpisodeRecord& e) { return !e.metrics.falls.empty(); });
  return fell ? "no episode with a fall kept a log" : "no episode fell";
}

Blocks BuildCourse(const ReportInput& input) {
  constexpr int kEvery = 4;  // rows: 8 ms, finer than a line can show
  constexpr std::size_t kMostRows = 200'000;
  constexpr std::size_t kMost = 2;
  Blocks blocks;
  std::size_t drawn = 0;
  for (const EpisodeRecord* e : WithLogs(input.results)) {
    if (drawn >= kMost) break;
    const logs::LogContent log = logs::ReadLog(LogOf(*e), kEvery);
    if (!log.problem.empty()) blocks.push_back(Note{log.problem});
    if (log.rows.empty()) continue;
    CourseFigure course(kMostRows);
    for (const logs::Row& row : log.rows) course.Add(row);
    blocks.push_back(course.Draw(
        e->id, log.falls_s, {},
        "Vertical dashes mark falls. Stance: normal force above 5 N (Go2). Fallback: of a foot "
        "sensor to the momentum observer, of stages by the supervisor."));
    ++drawn;
  }
  if (blocks.empty()) blocks.push_back(Paragraph{"The logs hold no rows."});
  return blocks;
}

}  // namespace

Section CourseSection() {
  return {"course", "Course of single episodes", WhyNoCourse, BuildCourse};
}

}  // namespace scoria::analysis
