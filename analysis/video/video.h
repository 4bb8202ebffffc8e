// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "core/robot/description.h"
#include "logs/row.h"
#include "terrains/heightfield.h"

namespace scoria::analysis {

struct VideoOptions {
  std::filesystem::path file;    // .mp4, H.264
  std::filesystem::path frames;  // folder for PNG frames; empty for none
  int width_px = 960, height_px = 540, fps = 30;
  int frame_every_s = 5;  // of the PNG frames
  std::string title;
  std::function<void(double share)> on_progress;
};

/// Edges of a frame: below, its text is not legible; above, H.264 players refuse it.
inline constexpr int kSmallestFrame_px = 64, kLargestFrame_px = 4096;

/// Whether a row says where the trunk and the joints are.
[[nodiscard]] bool CanDraw(const logs::Row& row) noexcept;

/// Errors: std::runtime_error that says what is wrong with the file's folder or extension.
void CheckVideoFile(const std::filesystem::path& file);

/// Renders rows of one log that can all be drawn: robot, ground, foot forces, planned footholds,
/// path walked, and a text overlay with time, speed and gait diagram. The file is there whole, as
/// read back, or not at all. Errors: std::runtime_error if no encoder or no OpenGL context is at
/// hand; as CheckVideoFile; core::FileError if the disk refuses the video.
void RenderVideo(std::span<const logs::Row> rows, const core::RobotDescription& robot,
                 const terrains::Heightfield& ground, const VideoOptions& options);

/// One frame of that video, at the last row, as a JPEG. Errors: as RenderVideo.
[[nodiscard]] std::string RenderStill(std::span<const logs::Row> rows,
                                      const core::RobotDescription& robot,
                                      const terrains::Heightfield& ground,
                                      const VideoOptions& options);

}  // namespace scoria::analysis
