// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/field/motion_samples.h"
#include "analysis/field/time_offset.h"

namespace scoria::analysis {

/// By which motion of the trunk a lever arm was found.
enum class LeverArmSource { kAccelerometer, kEstimate, kBoth };
constexpr std::array<std::pair<LeverArmSource, std::string_view>, 3> EnumNames(LeverArmSource) {
  using S = LeverArmSource;
  return {{{S::kAccelerometer, "accelerometer"},
           {S::kEstimate, "estimate"},
           {S::kBoth, "accelerometer and estimate"}}};
}

/// Where the body that a truth shows is on the trunk.
struct LeverArm {
  LeverArmSource source = LeverArmSource::kAccelerometer;
  Vec3 p_BM = Vec3::Zero();  // m, in B
  Vec3 sigma_m = Vec3::Zero();
};

/// Least squares on second differences,
///   D p_WM = D p_WB + tau D v_WB + D R_WB p_BM  with  D x = x(t + h) - 2 x(t) + x(t - h),
/// where a constant place and velocity of either side drop out, so that drift of an odometry is no
/// error. An accelerometer tells D p_WS by integration twice, with a constant bias that is
/// estimated along; h is 0.05 s, since its errors grow with the square of the time. Of an estimate
/// h is 0.15 s. tau is what either is later than the gyroscope, since a delay looks like a lever
/// arm where the trunk speeds up as it pitches. R_WB is the truth's. Samples every 20 ms at which
/// the trunk turns, weights of [Huber1964], standard errors of blocks of 1 s.
/// @param source  not kBoth.   @param p_BS  of the accelerometer.
/// @returns nothing where the log lacks that motion, or it does not tell all three components.
[[nodiscard]] std::optional<LeverArm> EstimateLeverArm(const std::vector<MotionSample>& samples,
                                                       const TimeOffset& offset,
                                                       LeverArmSource source, const Vec3& p_BS,
                                                       double gravity_mps2);

/// The mean of two, weighted by their standard errors; where they differ by more than those, its
/// standard error is larger by as much.
[[nodiscard]] LeverArm Combine(const LeverArm& a, const LeverArm& b) noexcept;

}  // namespace scoria::analysis
