// SPDX-License-Identifier: BSD-3-Clause
#include "logs/quality/stance_by_torque.h"

#include <algorithm>
#include <cmath>

namespace scoria::logs {
namespace {

constexpr double kLeast_Nm = 0.01, kBinsPerOctave = 8.0;
constexpr std::uint64_t kUpdateEvery = 25, kFirst = 50;  // ticks

}  // namespace

LegArray<bool> StanceByTorque::Update(const LegArray<Vec3>& tau) {
  LegArray<bool> loaded(false);
  if (std::all_of(tau.begin(), tau.end(), [&](const Vec3& t) { return t.norm() < least_Nm_; }))
    return loaded;  // the robot lies
  for (const Leg leg : kLegs) {
    const double size = tau[leg].norm();
    const double bin = kBinsPerOctave * std::log2(std::max(size, kLeast_Nm) / kLeast_Nm);
    ++histogram_[std::min(kBins - 1, static_cast<std::size_t>(bin))];
    loaded[leg] = threshold_Nm_ > 0.0 && size > std::max(threshold_Nm_, least_Nm_);
  }
  ++count_;
  if (count_ >= kFirst && count_ % kUpdateEvery == 0) UpdateThreshold();
  return loaded;
}

void StanceByTorque::UpdateThreshold() {
  const auto wanted = static_cast<std::uint64_t>(kLarge * static_cast<double>(kNumLegs * count_));
  std::uint64_t below = 0;
  std::size_t bin = 0;
  while (bin + 1 < kBins && below + histogram_[bin] < wanted) below += histogram_[bin++];
  threshold_Nm_ =
      kLoaded * kLeast_Nm * std::exp2((static_cast<double>(bin) + 0.5) / kBinsPerOctave);
}

}  // namespace scoria::logs
