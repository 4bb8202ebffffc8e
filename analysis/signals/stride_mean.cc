// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/stride_mean.h"

namespace scoria::analysis {

std::optional<Vec2> StrideMean::Add(double time_s, const Vec2& value, double stride_s) {
  constexpr double kRounding_s = 1e-9;
  samples_.push_back({time_s, value});
  bool whole = false;
  while (time_s - samples_[first_].time_s > stride_s - kRounding_s) {
    ++first_;
    whole = true;
  }
  if (!whole) return std::nullopt;
  Vec2 mean = Vec2::Zero();
  const auto n = static_cast<double>(samples_.size() - first_);
  for (std::size_t i = first_; i < samples_.size(); ++i) mean += samples_[i].value / n;
  constexpr std::size_t kMany = 4096;  // forgets what is done with, many at a time
  if (first_ > kMany) {
    samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(first_));
    first_ = 0;
  }
  return mean;
}

void StrideMean::Reset() noexcept {
  samples_.clear();
  first_ = 0;
}

}  // namespace scoria::analysis
