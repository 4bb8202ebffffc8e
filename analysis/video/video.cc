// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/video/video.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "analysis/metrics/estimation_metrics.h"
#include "analysis/signals/motion.h"
#include "analysis/video/scene.h"
#include "core/files.h"
#include "core/math/low_pass.h"
#include "core/math/so3.h"

namespace scoria::analysis {
namespace {

constexpr Colour kForceColour = {0.10f, 0.55f, 0.95f};
constexpr Colour kFootholdColour = {0.95f, 0.75f, 0.10f};
constexpr Colour kPathColour = {0.90f, 0.90f, 0.85f};
constexpr double kTrail_m = 4.0, kTrailSpacing_m = 0.1;

Vec3 ToVec3(const double* v) { return {v[0], v[1], v[2]}; }

/// Follows the robot from behind and to the side, turning slowly.
class Camera {
 public:
  void Update(const logs::Row& row, double dt_s, Frame& frame) {
    const TrunkMotion motion = FindMotion(row).value();
    const Vec3& p = motion.p_WB;
    const double yaw = motion.rpy_rad.z();
    constexpr double kSmooth_s = 0.8, kJump_m = 1.0;
    const double gain =
        started_ && (p - at_).norm() < kJump_m ? core::LowPassShare(kSmooth_s, dt_s) : 1.0;
    started_ = true;
    at_ += gain * (p - at_);
    yaw_ += gain * core::WrapToPi(yaw - yaw_);
    constexpr double kAzimuth_rad = 2.35, kDistance_m = 1.75, kHeight_m = 0.62;
    frame.look_at_W = at_ - Vec3(0.0, 0.0, 0.10);
    frame.eye_W = at_ + Vec3(kDistance_m * std::cos(yaw_ + kAzimuth_rad),
                             kDistance_m * std::sin(yaw_ + kAzimuth_rad), kHeight_m);
  }

 private:
  Vec3 at_ = Vec3::Zero();
  double yaw_ = 0.0;
  bool started_ = false;
};

void AddForce(const Vec3& p_WF, const Vec3& f_F_W, Frame& frame) {
  constexpr double kMetresPerNewton = 0.25 / 75.0, kLongest_m = 0.6, kShortest_m = 0.01;
  const Vec3 arrow = kMetresPerNewton * f_F_W;
  const double shown_m = std::min(arrow.norm(), kLongest_m);
  if (shown_m > kShortest_m)
    frame.sticks.push_back({p_WF, p_WF + shown_m * arrow.normalized(), 0.008, kForceColour});
}

/// Where the swing legs are meant to touch. Without truth the scene is the estimator's frame.
void AddFootholds(const logs::Row& row, Frame& frame) {
  const bool operating = row.episode && row.episode->operating;
  if (!operating || !row.plan || !row.plan->leg_mode || !row.plan->foot_target_m) return;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    if ((*row.plan->leg_mode)[leg] != 1) continue;
    const Vec3 target = ToVec3(&(*row.plan->foot_target_m)[3 * leg]);
    frame.balls.push_back(
        {FromEstimatorFrame(row, target).value_or(target), 0.012, kFootholdColour});
  }
}

/// The path walked since the last placement, as dots on the ground.
void AddTrail(const logs::Row& row, std::span<const logs::Row> before, Frame& frame) {
  Vec2 last = frame.p_WB.head<2>();
  double trail_m = 0.0;
  for (auto r = before.rbegin(); r != before.rend() && trail_m < kTrail_m; ++r) {
    if (r->episode && row.episode && r->episode->segment != row.episode->segment) return;
    const auto motion = FindMotion(*r);
    if (!motion || !motion->ground_z_m) return;
    const Vec2 p = motion->p_WB.head<2>();
    if ((p - last).norm() < kTrailSpacing_m) continue;
    trail_m += (p - last).norm();
    last = p;
    frame.balls.push_back({Vec3(p.x(), p.y(), *motion->ground_z_m + 0.01), 0.012, kPathColour});
  }
}

/// @pre CanDraw(row).
Frame MakeFrame(const logs::Row& row, std::span<const logs::Row> before) {
  Frame frame;
  const TrunkMotion motion = FindMotion(row).value();
  frame.p_WB = motion.p_WB;
  frame.R_WB = core::RotationFromRpy(motion.rpy_rad);
  const logs::Array12& q_rad = row.true_joints ? row.true_joints->q_rad : *row.measured->q_rad;
  frame.q = Unflatten(q_rad);
  if (row.true_contacts && row.true_contacts->p_WF_m && row.true_contacts->f_F_W_N) {
    const LegArray<Vec3> p_WF = Unflatten(*row.true_contacts->p_WF_m);
    const LegArray<Vec3> f_F_W = Unflatten(*row.true_contacts->f_F_W_N);
    for (const Leg leg : kLegs) AddForce(p_WF[leg], f_F_W[leg], frame);
  }
  AddFootholds(row, frame);
  AddTrail(row, before, frame);
  return frame;
}

/// Whether a foot bears weight: truly, or for want of that as estimated.
bool BearsWeight(const logs::Row& row, std::size_t leg) {
  if (row.true_contacts && row.true_contacts->f_F_W_N)
    return (*row.true_contacts->f_F_W_N)[3 * leg + 2] > 5.0;
  if (row.true_contacts) return row.true_contacts->contact[leg];
  return row.contacts && row.contacts->contact[leg];
}

void Text(cv::Mat& image, const std::string& text, int x, int y, double scale = 0.55) {
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, scale, {30, 30, 30}, 3, cv::LINE_AA);
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, scale, {255, 255, 255}, 1,
              cv::LINE_AA);
}

/// Which feet bore weight over the last two seconds, FL FR HL HR from the top, now at the right.
void DrawGaitDiagram(cv::Mat& image, std::span<const logs::Row> rows, std::size_t now) {
  constexpr double kSpan_s = 2.0;
  constexpr int kWidth = 260, kRow = 16, kMargin = 16, kNames = 40;
  const bool fits =
      image.cols >= kWidth + kNames + 2 * kMargin && image.rows >= 4 * kRow + 4 * kMargin;
  if (!fits) return;
  const int left = image.cols - kWidth - kMargin, top = image.rows - 4 * kRow - kMargin - 8;
  cv::Mat panel = image(cv::Rect(left - kNames, top - 6, kWidth + 48, 4 * kRow + 12));
  panel = panel * 0.45;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    const int y = top + kRow * static_cast<int>(leg);
    Text(image, std::string(LegName(kLegs[leg])), left - 34, y + 12, 0.42);
    const double t_now = rows[now].time_s;
    for (std::size_t i = now + 1; i-- > 0 && rows[i].time_s > t_now - kSpan_s;) {
      if (!BearsWeight(rows[i], leg)) continue;
      const int x =
          left + static_cast<int>((rows[i].time_s - t_now + kSpan_s) / kSpan_s * (kWidth - 2));
      cv::rectangle(image, {x, y + 2}, {x + 1, y + kRow - 3}, {240, 200, 90}, cv::FILLED);
    }
  }
}

void DrawOverlay(cv::Mat& image, std::span<const logs::Row> rows, std::size_t now,
                 const std::string& title) {
  const logs::Row& r = rows[now];
  const double v = FindMotion(r).value().v_WB.head<2>().norm();
  const std::string asked =
      r.command
          ? fmt::format(" (asked {:4.2f})", std::hypot(r.command->v_x_mps, r.command->v_y_mps))
          : "";
  Text(image, title, 16, 28, 0.65);
  Text(image, fmt::format("t {:6.2f} s    v {:4.2f} m/s{}", r.time_s, v, asked), 16, 54);
  if (r.plan)
    Text(image, fmt::format("T {:4.2f} s    d {:4.2f}", r.plan->period_s, r.plan->duty), 16, 78);
  if (r.episode && r.episode->fallen) Text(image, "FALLEN", image.cols / 2 - 60, 60, 1.0);
  DrawGaitDiagram(image, rows, now);
}

/// The scene with its overlay, as OpenCV writes it.
cv::Mat DrawImage(Scene& scene, const Frame& frame, std::span<const logs::Row> rows,
                  std::size_t now, const VideoOptions& options) {
  const cv::Mat bgra(cv::Size(options.width_px, options.height_px), CV_8UC4,
                     const_cast<std::uint8_t*>(scene.Draw(frame)));
  cv::Mat image;
  cv::cvtColor(bgra, image, cv::COLOR_BGRA2BGR);
  DrawOverlay(image, rows, now, options.title);
  return image;
}

/// A video that takes its name once it is whole.
class VideoFile {
 public:
  VideoFile(const VideoOptions& options, cv::Size size)
      : file_(options.file), draft_(file_.string() + ".part.mp4") {
    if (!writer_.open(draft_.string(), cv::CAP_FFMPEG, cv::VideoWriter::fourcc('a', 'v', 'c', '1'),
                      options.fps, size, true)) {
      throw std::runtime_error(fmt::format("{}: cannot open an H.264 encoder", file_.string()));
    }
  }
  ~VideoFile() {
    writer_.release();
    std::error_code ignored;
    std::filesystem::remove(draft_, ignored);  // gone already where all went well
  }
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  void Write(const cv::Mat& image) {
    writer_.write(image);
    ++written_;
  }

  /// The encoder tells of no error: the frames are counted in what it wrote.
  void Close() {
    writer_.release();
    int whole = 0;
    cv::VideoCapture reader;
    if (std::filesystem::exists(draft_) && reader.open(draft_.string(), cv::CAP_FFMPEG)) {
      while (reader.grab()) ++whole;
    }
    if (whole != written_) {
      std::error_code error;
      const auto space = std::filesystem::space(file_.parent_path() / ".", error);
      constexpr std::uintmax_t kLittle = 1 << 20;
      const bool full = !error && space.available < kLittle;
      throw core::FileError(
          file_,
          fmt::format("the video could not be written whole, {} of {} frames", whole, written_),
          full ? ENOSPC : 0);
    }
    if (std::rename(draft_.c_str(), file_.c_str()) != 0)
      throw core::FileError(file_, "cannot write", errno);
  }

 private:
  std::filesystem::path file_, draft_;
  cv::VideoWriter writer_;
  int written_ = 0;
};

void WriteFrame(const std::filesystem::path& file, const cv::Mat& image) {
  std::vector<uchar> png;
  cv::imencode(".png", image, png);
  core::WriteText(file, std::string(png.begin(), png.end()));
}

}  // namespace

std::string RenderStill(std::span<const logs::Row> rows, const core::RobotDescription& robot,
                        const terrains::Heightfield& ground, const VideoOptions& options) {
  if (rows.empty()) throw std::runtime_error("picture: the log has no rows in this span");
  Scene scene(robot, ground, options.width_px, options.height_px);
  const std::size_t now = rows.size() - 1;
  Frame frame = MakeFrame(rows[now], rows.first(now));
  Camera().Update(rows[now], 0.0, frame);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", DrawImage(scene, frame, rows, now, options), bytes);
  return {bytes.begin(), bytes.end()};
}

bool CanDraw(const logs::Row& row) noexcept {
  const auto motion = FindMotion(row);
  const bool joints = row.true_joints || (row.measured && row.measured->q_rad);
  return joints && motion && motion->p_WB.allFinite();
}

void CheckVideoFile(const std::filesystem::path& file) {
  if (file.extension() != ".mp4") {
    throw std::runtime_error(fmt::format("{}: ends in \"{}\"; a video is an .mp4 file",
                                         file.string(), file.extension().string()));
  }
  const std::filesystem::path folder = file.parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder))
    throw std::runtime_error(
        fmt::format("{}: there is no folder {}", file.string(), folder.string()));
}

void RenderVideo(std::span<const logs::Row> rows, const core::RobotDescription& robot,
                 const terrains::Heightfield& ground, const VideoOptions& options) {
  CheckVideoFile(options.file);
  if (rows.empty()) throw std::runtime_error("video: the log has no rows in this span");
  Scene scene(robot, ground, options.width_px, options.height_px);
  const cv::Size size(options.width_px, options.height_px);
  VideoFile video(options, size);
  if (!options.frames.empty()) core::CreateFolders(options.frames);

  Camera camera;
  const double dt_s = 1.0 / options.fps, start_s = rows.front().time_s,
               length_s = rows.back().time_s - start_s;
  const int frames = std::max(1, static_cast<int>(length_s * options.fps));
  std::size_t now = 0;
  for (int k = 0; k < frames; ++k) {
    while (now + 1 < rows.size() && rows[now + 1].time_s <= start_s + k * dt_s) ++now;
    Frame frame = MakeFrame(rows[now], rows.first(now));
    camera.Update(rows[now], dt_s, frame);
    const cv::Mat image = DrawImage(scene, frame, rows, now, options);
    video.Write(image);
    if (!options.frames.empty() && k % (options.frame_every_s * options.fps) == 0) {
      WriteFrame(options.frames / fmt::format("frame_{:05d}.png", k), image);
    }
    if (options.on_progress) options.on_progress(static_cast<double>(k) / frames);
  }
  video.Close();
}

}  // namespace scoria::analysis
