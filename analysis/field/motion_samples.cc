// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/motion_samples.h"

#include <algorithm>
#include <cmath>

#include "core/math/so3.h"

namespace scoria::analysis {
namespace {

std::optional<BodyPose> PoseOf(const logs::Tick& tick, logs::MotionSource source) {
  const auto s = static_cast<std::size_t>(source);
  if (!tick.R_WB[s] || !tick.p_WB[s]) return std::nullopt;
  return BodyPose{*tick.R_WB[s], *tick.p_WB[s]};
}

MotionSample ToSample(const logs::Tick& tick) {
  return {tick.w_WB_B, tick.a_WS_B, PoseOf(tick, logs::MotionSource::kTruth),
          PoseOf(tick, logs::MotionSource::kEstimate)};
}

}  // namespace

BodyPose Interpolate(const BodyPose& a, const BodyPose& b, double s) noexcept {
  return {a.R_WB * core::ExpSo3(s * core::LogSo3(a.R_WB.transpose() * b.R_WB)),
          (1.0 - s) * a.p_WB + s * b.p_WB};
}

void MotionSamples::Add(const logs::Row& row) {
  constexpr auto kMost = static_cast<std::size_t>(kLongest_s / kStep_s);
  if (samples_.size() >= kMost) return;
  const logs::Tick tick = logs::MakeTick(row, robot_);
  std::optional<std::uint32_t> segment;
  if (row.episode) segment = row.episode->segment;
  const double step_s = last_ ? tick.time_s - last_->time_s : 0.0;
  if (!last_ || segment != segment_ || step_s < 0.0 || step_s > kSeparation_s) {
    if (last_) samples_.resize(samples_.size() + std::size_t(kSeparation_s / kStep_s));
    next_s_ = tick.time_s;
  } else if (step_s > 0.0) {
    for (; next_s_ <= tick.time_s; next_s_ += kStep_s) {
      const double share = std::max(0.0, (next_s_ - last_->time_s) / step_s);
      samples_.push_back(step_s > kLongestPause_s
                             ? MotionSample()
                             : ToSample(logs::Interpolate(*last_, tick, share)));
    }
  }
  last_ = tick;
  segment_ = segment;
}

std::optional<BodyPose> TruthAt(const std::vector<MotionSample>& samples, std::size_t i,
                                double delay_s) {
  const double at = static_cast<double>(i) + delay_s / MotionSamples::kStep_s;
  if (at < 0.0) return std::nullopt;
  const auto before = static_cast<std::size_t>(at);
  if (before + 1 >= samples.size()) return std::nullopt;
  const auto &a = samples[before].truth, &b = samples[before + 1].truth;
  if (!a || !b) return std::nullopt;
  return Interpolate(*a, *b, at - static_cast<double>(before));
}

}  // namespace scoria::analysis
