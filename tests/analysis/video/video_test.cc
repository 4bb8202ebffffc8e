// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/video/video.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include "core/files.h"
#include "tests/support/program.h"
#include "tests/support/robots.h"
#include "tests/support/rows.h"

namespace scoria::analysis {
namespace {

namespace fs = std::filesystem;

/// A robot that stands for a while.
std::vector<logs::Row> StandingRows(double length_s) {
  std::vector<logs::Row> rows;
  for (double t = 0.0; t <= length_s; t += 0.01) {
    logs::Row row = test::WholeRow();
    row.time_s = t;
    row.truth->p_WB_m = {0.0, 0.0, 0.3};
    (*row.true_contacts->f_F_W_N)[2] = 40.0;
    rows.push_back(row);
  }
  return rows;
}

void Render(const VideoOptions& options, double length_s = 0.2) {
  RenderVideo(StandingRows(length_s), test::Go2(), test::FlatGround(), options);
}

std::string Refusal(const fs::path& file) {
  try {
    CheckVideoFile(file);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "none";
}

TEST(Video, FrameOfAnyAllowedSizeIsDrawn) {
  const test::TemporaryFolder folder;
  for (const auto& [width, height] : {std::pair{64, 64},
                                      {300, 300},
                                      {316, 94},
                                      {331, 2000},
                                      {2000, 65},
                                      {332, 127},
                                      {961, 541}}) {
    VideoOptions options;
    options.file = folder.path() / fmt::format("{}x{}.mp4", width, height);
    options.width_px = width;
    options.height_px = height;
    EXPECT_NO_THROW(Render(options)) << width << "x" << height;
    EXPECT_GT(fs::file_size(options.file), 500u);
  }
}

TEST(Video, WrongFileIsSaid) {
  const test::TemporaryFolder folder;
  EXPECT_EQ(Refusal(folder.path() / "v.gif"),
            (folder.path() / "v.gif").string() + ": ends in \".gif\"; a video is an .mp4 file");
  EXPECT_EQ(Refusal("v"), "v: ends in \"\"; a video is an .mp4 file");
  const fs::path nowhere = folder.path() / "no";
  EXPECT_EQ(Refusal(nowhere / "v.mp4"),
            (nowhere / "v.mp4").string() + ": there is no folder " + nowhere.string());
  EXPECT_EQ(Refusal("v.mp4"), "none");
}

TEST(Video, OnAFullDiskIsAnErrorAndNoFile) {
  const test::TemporaryFolder folder;
  const fs::path disk = folder.path() / "disk", file = disk / "v.mp4";
  fs::create_directory(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=20k") != 0)
    GTEST_SKIP() << "only root may mount the small disk";
  VideoOptions options;
  options.file = file;
  try {
    Render(options, 3.0);
    ADD_FAILURE() << "written";
  } catch (const core::FileError& e) {
    const std::string what = e.what();
    EXPECT_EQ(what.find(file.string() + ": the video could not be written whole, "), 0u) << what;
    EXPECT_NE(what.find(" frames: no space left on device"), std::string::npos) << what;
  }
  EXPECT_TRUE(fs::is_empty(disk));
  umount2(disk.c_str(), MNT_DETACH);
}

TEST(RenderCommand, SizesAreTakenInBothFormsOrRefusedByRange) {
  const test::TemporaryFolder folder;
  const auto render = [&](std::vector<std::string> size) {
    size.insert(size.begin(), {"render", "--size"});
    size.push_back((folder.path() / "none.mcap").string());
    return test::RunScoria(size).output;
  };
  // Sizes that are taken fail later, for the log.
  EXPECT_NE(render({"960", "540"}).find("none.mcap: cannot read the file"), std::string::npos);
  EXPECT_NE(render({"960x540"}).find("none.mcap: cannot read the file"), std::string::npos);
  EXPECT_NE(render({"960x32"}).find("32 is outside [64, 4096] px"), std::string::npos);
  EXPECT_NE(render({"8000", "540"}).find("8000 is outside [64, 4096] px"), std::string::npos);
  EXPECT_NE(render({"wide"}).find("--size: "), std::string::npos);
}

}  // namespace
}  // namespace scoria::analysis
