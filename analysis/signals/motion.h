// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "core/math/types.h"
#include "logs/row.h"

namespace scoria::analysis {

/// Where a number of the trunk's motion is from.
enum class MotionSource { kTruth, kEstimate };
constexpr std::array<std::pair<MotionSource, std::string_view>, 2> EnumNames(MotionSource) {
  return {{{MotionSource::kTruth, "truth"}, {MotionSource::kEstimate, "estimate"}}};
}

/// Motion of the trunk at one instant. By the estimate, W is the estimator's frame.
struct TrunkMotion {
  MotionSource source = MotionSource::kTruth;
  Vec3 p_WB = Vec3::Zero(), v_WB = Vec3::Zero(), rpy_rad = Vec3::Zero();
  std::optional<double> ground_z_m = std::nullopt;  // under the trunk
};

/// None where the row lacks that source.
[[nodiscard]] std::optional<TrunkMotion> FindMotion(const logs::Row& row, MotionSource source);

/// By the truth, or for want of it by the estimate.
[[nodiscard]] std::optional<TrunkMotion> FindMotion(const logs::Row& row);

}  // namespace scoria::analysis
