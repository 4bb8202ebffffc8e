// SPDX-License-Identifier: BSD-3-Clause
#include "app/check/failure_artifacts.h"

#include <algorithm>

#include "analysis/report/course_figure.h"
#include "analysis/signals/motion.h"
#include "analysis/video/video.h"
#include "app/run/log_origin.h"

namespace scoria::app {
namespace {

namespace fs = std::filesystem;

constexpr double kBefore_s = 4.0, kAfter_s = 1.5;  // the moment, in clip and figure

double TiltOf(const logs::Row& row) {
  const auto motion = analysis::FindMotion(row);
  return motion ? motion->rpy_rad.head<2>().norm() : 0.0;
}

void DrawClip(const fs::path& log, std::vector<logs::Row> rows, const fs::path& file) {
  std::erase_if(rows, [](const logs::Row& r) { return !analysis::CanDraw(r); });
  const LogOrigin origin = ReadLogOrigin(log);
  analysis::VideoOptions options;
  options.file = file;
  options.width_px = 640;
  options.height_px = 360;
  options.fps = 15;
  options.title = origin.scenario.name;
  analysis::RenderVideo(rows, RobotOf(origin), GroundOf(origin), options);
}

}  // namespace

double FindMoment(const logs::LogContent& log) {
  if (!log.falls_s.empty()) return log.falls_s.front();
  return std::ranges::max_element(log.rows, {}, TiltOf)->time_s;
}

FailureArtifacts MakeFailureArtifacts(const fs::path& folder) {
  FailureArtifacts made;
  const fs::path log = folder / "log.mcap";
  try {
    logs::LogContent content = logs::ReadLog(log);
    if (content.rows.empty()) return {{}, content.problem.empty() ? "no log" : content.problem};
    made.files.push_back(log);
    const double moment_s = FindMoment(content);
    std::erase_if(content.rows, [&](const logs::Row& r) {
      return r.time_s < moment_s - kBefore_s || r.time_s > moment_s + kAfter_s;
    });
    analysis::CourseFigure course(content.rows.size());
    for (const logs::Row& row : content.rows) course.Add(row);
    course.Draw("moment", content.falls_s, {}, "").figure.Render(folder);
    made.files.push_back(folder / "time_moment.png");
    DrawClip(log, std::move(content.rows), folder / "moment.mp4");
    made.files.push_back(folder / "moment.mp4");
  } catch (const std::exception& e) {  // no gnuplot, no OpenGL: the verdict stands without them
    made.problem = e.what();
  }
  return made;
}

}  // namespace scoria::app
