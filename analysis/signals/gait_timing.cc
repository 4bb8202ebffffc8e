// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/gait_timing.h"

#include <cmath>
#include <numbers>

namespace scoria::analysis {
namespace {

std::optional<double> Ratio(double sum, double of) noexcept {
  return of > 0.0 ? std::optional(sum / of) : std::nullopt;
}

}  // namespace

StrideBin& StrideBin::operator+=(const StrideBin& other) noexcept {
  count += other.count;
  stride_s += other.stride_s;
  stance_s += other.stance_s;
  return *this;
}

void LegTiming::Add(double stride_s, double stance_s) {
  bins[static_cast<int>(stride_s / kBin_s)] += {1, stride_s, stance_s};
}

StrideBin LegTiming::Regular() const {
  std::uint64_t all = 0, below = 0;
  for (const auto& [number, bin] : bins) all += bin.count;
  double median_s = 0.0;
  for (const auto& [number, bin] : bins) {
    if (2 * below < all) median_s = bin.stride_s / static_cast<double>(bin.count);
    below += bin.count;
  }
  StrideBin regular;
  for (const auto& [number, bin] : bins) {
    const double mean_s = bin.stride_s / static_cast<double>(bin.count);
    if (mean_s * kRegular >= median_s && mean_s <= kRegular * median_s) regular += bin;
  }
  return regular;
}

std::optional<double> LegTiming::MeanStride() const {
  const StrideBin regular = Regular();
  return Ratio(regular.stride_s, static_cast<double>(regular.count));
}

std::optional<double> LegTiming::MeanStance() const {
  const StrideBin regular = Regular();
  return Ratio(regular.stance_s, static_cast<double>(regular.count));
}

std::optional<double> LegTiming::Duty() const {
  const StrideBin regular = Regular();
  return Ratio(regular.stance_s, regular.stride_s);
}

std::optional<double> LegTiming::Phase() const {
  if (phases == 0) return std::nullopt;
  const double turns = std::arg(phase) / (2.0 * std::numbers::pi);
  return turns < 0.0 ? turns + 1.0 : turns;
}

LegTiming& LegTiming::operator+=(const LegTiming& other) {
  for (const auto& [number, bin] : other.bins) bins[number] += bin;
  phase += other.phase;
  phases += other.phases;
  return *this;
}

GaitTiming& GaitTiming::operator+=(const GaitTiming& other) {
  for (const Leg leg : kLegs) legs[leg] += other.legs[leg];
  return *this;
}

void GaitTimer::Break() noexcept {
  legs_ = {};
  started_ = false;
  reference_s_.reset();
  reference_stride_s_.reset();
}

void GaitTimer::Add(double time_s, const logs::PerLeg<bool>& contact, const OnStride& on_stride) {
  for (const Leg leg : kLegs) {
    LegState& state = legs_[leg];
    const bool now = contact[static_cast<std::size_t>(leg)];
    if (!started_) state.on = now;
    if (started_ && now != state.raw) state.raw_s = 0.5 * (last_s_ + time_s);
    state.raw = now;
    if (state.raw_s && time_s - *state.raw_s >= kBounce_s) Settle(leg, state, on_stride);
  }
  started_ = true;
  last_s_ = time_s;
}

/// The last change of the contact has lasted.
void GaitTimer::Settle(Leg leg, LegState& state, const OnStride& on_stride) {
  if (state.on == state.raw) return;
  state.on = state.raw;
  if (state.raw) {
    Touchdown(leg, *state.raw_s, on_stride);
  } else {
    state.up_s = state.raw_s;
  }
}

void GaitTimer::Touchdown(Leg leg, double time_s, const OnStride& on_stride) {
  LegState& state = legs_[leg];
  LegTiming& timing = timing_.legs[leg];
  if (state.down_s && state.up_s && time_s - *state.down_s <= kLongest_s) {
    const Stride stride{time_s - *state.down_s, *state.up_s - *state.down_s};
    timing.Add(stride.stride_s, stride.stance_s);
    if (on_stride) on_stride(stride);
    if (leg == Leg::kFL) reference_stride_s_ = stride.stride_s;
  }
  if (leg == Leg::kFL) reference_s_ = time_s;
  if (reference_s_ && reference_stride_s_) {
    const double share = (time_s - *reference_s_) / *reference_stride_s_;
    timing.phase += std::polar(1.0, 2.0 * std::numbers::pi * share);
    ++timing.phases;
  }
  state.down_s = time_s;
  state.up_s.reset();
}

}  // namespace scoria::analysis
