// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "analysis/report/sections/sections.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

std::vector<VideoLink> FindVideos(const fs::path& folder) {
  std::vector<VideoLink> videos;
  constexpr auto kSkip = fs::directory_options::skip_permission_denied;
  for (const auto& entry : fs::recursive_directory_iterator(folder, kSkip)) {
    const bool unfinished = entry.path().stem().extension() == ".part";
    if (entry.path().extension() != ".mp4" || unfinished) continue;
    videos.push_back(
        {"../" + fs::relative(entry.path(), folder).string(), entry.path().stem().string()});
  }
  std::sort(videos.begin(), videos.end(),
            [](const VideoLink& a, const VideoLink& b) { return a.path < b.path; });
  return videos;
}

std::optional<std::string> WhyNoVideos(const ReportInput& input) {
  if (FindVideos(input.folder).empty()) return "there is none in the folder";
  return std::nullopt;
}

Blocks BuildVideos(const ReportInput& input) {
  Blocks blocks;
  for (VideoLink& video : FindVideos(input.folder)) blocks.push_back(std::move(video));
  return blocks;
}

}  // namespace

Section VideosSection() { return {"videos", "Videos", WhyNoVideos, BuildVideos}; }

}  // namespace scoria::analysis
