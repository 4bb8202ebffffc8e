// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "analysis/video/video.h"
#include "app/cli/commands.h"
#include "app/cli/note.h"
#include "app/cli/progress.h"
#include "app/episode/record.h"
#include "app/run/log_origin.h"
#include "core/robot_files/mesh_records.h"
#include "logs/read_rows.h"

namespace scoria::app {
namespace {

/// @returns what is wrong with the width or height of a video; empty if nothing.
std::string CheckFrameEdge(const std::string& text) {
  int edge_px = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), edge_px);
  if (error != std::errc{} || stop != text.data() + text.size())
    return fmt::format("\"{}\" is not a number of pixels", text);
  const bool fits = edge_px >= analysis::kSmallestFrame_px && edge_px <= analysis::kLargestFrame_px;
  return fits ? ""
              : fmt::format(
                    "{} is outside [{}, {}] px: smaller frames hold no text, larger ones "
                    "no player shows",
                    edge_px, analysis::kSmallestFrame_px, analysis::kLargestFrame_px);
}

}  // namespace

void AddRender(CLI::App& app) {
  struct Options {
    std::string log, out, frames;
    double from_s = 0.0, to_s = 1e9;
    std::vector<int> size = {960, 540};
    int fps = 30;
  };
  auto o = std::make_shared<Options>();
  CLI::App* render = app.add_subcommand("render", "make an H.264 video of a log, without a screen");
  render->add_option("log", o->log, "MCAP log that scoria wrote")->required();
  render->add_option("--out", o->out, "video file (default: beside the log)");
  render->add_option("--frames", o->frames, "folder for a PNG every five seconds");
  render->add_option("--from", o->from_s, "start [s]");
  render->add_option("--to", o->to_s, "end [s]");
  render->add_option("--size", o->size, "width and height [px], as 960 540 or 960x540")
      ->expected(2)
      ->delimiter('x')
      ->check(CLI::Validator(CheckFrameEdge, ""));
  render->add_option("--fps", o->fps, "frames per second")->check(CLI::Range(1, 240));
  render->callback([o] {
    analysis::VideoOptions options;
    options.file = o->out.empty() ? std::filesystem::path(o->log).replace_extension(".mp4")
                                  : std::filesystem::path(o->out);
    analysis::CheckVideoFile(options.file);  // before the long way there
    const LogOrigin origin = ReadLogOrigin(o->log);
    if (const std::string missing = MissingTopics(origin.scenario.log); !missing.empty())
      throw std::runtime_error(
          fmt::format("{}: {}, without the rows that a video needs; record it with log.topics=all",
                      o->log, missing));
    core::RobotDescription robot = RobotOf(origin);
    for (const std::string& remark : core::DrawLostMeshesAsBoxes(robot)) Note(remark);
    const terrains::Heightfield ground = GroundOf(origin);
    logs::LogContent content = logs::ReadLog(o->log);
    if (!content.problem.empty()) Note(content.problem);
    std::erase_if(content.rows, [&](const logs::Row& r) {
      return !analysis::CanDraw(r) || r.time_s < o->from_s || r.time_s > o->to_s;
    });
    options.frames = o->frames;
    options.width_px = o->size[0];
    options.height_px = o->size[1];
    options.fps = o->fps;
    options.title = origin.scenario.name;
    {
      ProgressBar bar("video");
      options.on_progress = [&](double share) { bar.Update(share, ""); };
      analysis::RenderVideo(content.rows, robot, ground, options);
    }
    fmt::print("{}\n", options.file.string());
  });
}

}  // namespace scoria::app
