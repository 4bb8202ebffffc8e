// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/field/motion_samples.h"

namespace scoria::analysis {

/// How a truth lies against the gyroscope: in time, and how its body is turned on the trunk.
struct TimeOffset {
  double delay_s = 0.0;  // what the truth shows at t was the robot's motion at t - delay_s
  double sigma_s = 0.0;
  Mat3 R_BM = Mat3::Identity();  // axes of the truth's body M in the trunk
  Vec3 sigma_BM_rad = Vec3::Zero();
  double left = 0.0;  // of the mean square of the rate, what the truth does not explain, 0 to 1
};

struct TimeOffsetResult {
  std::optional<TimeOffset> offset;
  std::string refusal;  // why there is none, in words; empty if there is
};

/// Delays that are looked for, either way.
inline constexpr double kLargestDelay_s = 3.0;

/// Finds delay and axes at which the rate of the truth's attitude is that of the gyroscope, both as
/// means over 40 ms: every 20 ms of delay with the best rotation for it ([Kabsch1976]), then by
/// Gauss-Newton with a constant bias of the gyroscope. The standard errors are of means over 1 s.
/// It is refused where the log lacks either, the trunk does not turn, no delay explains half of the
/// rate's square, or another delay explains it as well: a gait repeats itself.
[[nodiscard]] TimeOffsetResult EstimateTimeOffset(const std::vector<MotionSample>& samples);

}  // namespace scoria::analysis
