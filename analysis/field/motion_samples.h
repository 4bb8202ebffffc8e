// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/math/types.h"
#include "core/robot/description.h"
#include "logs/quality/tick.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Where a body is in W.
struct BodyPose {
  Mat3 R_WB = Mat3::Identity();
  Vec3 p_WB = Vec3::Zero();
};

/// The pose between two, by the share `s` in [0, 1] of the way.
[[nodiscard]] BodyPose Interpolate(const BodyPose& a, const BodyPose& b, double s) noexcept;

/// One instant as the alignment of a truth sees it; absent is what the log lacks there.
struct MotionSample {
  std::optional<Vec3> w_WB_B = std::nullopt;        // gyroscope, rad/s
  std::optional<Vec3> a_WS_B = std::nullopt;        // accelerometer, specific force, m/s^2
  std::optional<BodyPose> truth = std::nullopt;     // as read, at the row's time
  std::optional<BodyPose> estimate = std::nullopt;  // of the log
};

/// Rows of a log at even steps, for calculations that look at instants before and after. Keeps the
/// first kLongest_s of the log and no more: memory does not grow beyond that.
class MotionSamples {
 public:
  static constexpr double kStep_s = 0.005;
  static constexpr double kLongest_s = 600.0;
  /// Samples are interpolated over shorter pauses alone; longer ones leave empty samples. Instants
  /// beyond a pause of kSeparation_s, and beyond a placement or a clock that goes back, stand so
  /// far from each other: no calculation joins them.
  static constexpr double kLongestPause_s = 0.05, kSeparation_s = 4.0;

  /// @param robot  where the IMU is turned to; borrowed; null: the axes of the trunk.
  explicit MotionSamples(const core::RobotDescription* robot) : robot_(robot) {}
  void Add(const logs::Row& row);
  [[nodiscard]] const std::vector<MotionSample>& samples() const noexcept { return samples_; }

 private:
  const core::RobotDescription* robot_;
  std::optional<logs::Tick> last_;
  std::optional<std::uint32_t> segment_;
  double next_s_ = 0.0;
  std::vector<MotionSample> samples_;
};

/// The truth `delay_s` after sample `i`; nothing where it is not known.
[[nodiscard]] std::optional<BodyPose> TruthAt(const std::vector<MotionSample>& samples,
                                              std::size_t i, double delay_s);

}  // namespace scoria::analysis
