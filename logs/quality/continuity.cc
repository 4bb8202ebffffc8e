// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/continuity.h"

#include <cmath>

namespace scoria::logs {
namespace {

// The robot has to move by so much, rad or m, for a verdict: all joints together by one degree
// each, its place by a step's tenth.
constexpr double kLeastJoints_rad = 0.06, kLeastPosition_m = 0.02;

Vec12 ToVector(const LegArray<Vec3>& joints) {
  const std::array<double, kNumJoints> flat = Flatten(joints);
  return Eigen::Map<const Vec12>(flat.data());
}

std::optional<Vec3> PositionOf(const Tick& tick) {
  constexpr auto kTruth = static_cast<std::size_t>(MotionSource::kTruth);
  constexpr auto kEstimate = static_cast<std::size_t>(MotionSource::kEstimate);
  return tick.p_WB[kTruth] ? tick.p_WB[kTruth] : tick.p_WB[kEstimate];
}

}  // namespace

template <int kSize>
void Continuity::Course<kSize>::Add(const Vector& value, bool is_neighbour) {
  if (!last_) mean_ = value;
  if (last_ && is_neighbour) step_ += kStepMemory * ((value - *last_).norm() - step_);
  mean_ += kMemory * (value - mean_);
  variance_ += kMemory * ((value - mean_).squaredNorm() - variance_);
  last_ = value;
}

template <int kSize>
std::optional<Continuity::Verdict> Continuity::Course<kSize>::Judge(const Vector& value,
                                                                    double samples,
                                                                    double least_motion) const {
  if (!last_) return std::nullopt;
  const double moved = (value - *last_).norm();
  // Neither the noise of neighbours nor what moves in a pause of theirs.
  constexpr double kNeighbours = 3.0, kFar = 6.0;
  if (moved > kFar * step_ && moved > 0.1 * least_motion) return Verdict::kJumps;
  // Going on as before, it would be far by now.
  const bool could_move = std::sqrt(variance_) > least_motion && samples > 4.0 * kFar &&
                          samples * step_ > 3.0 * least_motion;
  return moved <= kNeighbours * step_ && could_move ? Verdict::kContinues
                                                    : Verdict::kNotEnoughMotion;
}

Continuity::Verdict Continuity::Judge(const Tick& sample, double samples) const {
  std::optional<Verdict> joints, position;
  if (sample.q) joints = joints_.Judge(ToVector(*sample.q), samples, kLeastJoints_rad);
  if (const auto p = PositionOf(sample)) position = position_.Judge(*p, samples, kLeastPosition_m);
  if (joints == Verdict::kJumps || position == Verdict::kJumps) return Verdict::kJumps;
  // The joints move most; a position may be that of another clock, which a mapping holds.
  return joints.value_or(position.value_or(Verdict::kNotEnoughMotion));
}

void Continuity::Add(const Tick& sample, bool is_neighbour) {
  if (sample.q) joints_.Add(ToVector(*sample.q), is_neighbour);
  if (const auto p = PositionOf(sample)) position_.Add(*p, is_neighbour);
}

}  // namespace scoria::logs
