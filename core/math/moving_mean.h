// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>

namespace scoria::core {

/// Mean of the last `samples` values (fewer at the start), at most kMax. T adds and divides by a
/// double.
template <class T, int kMax>
class MovingMean {
 public:
  explicit MovingMean(int samples) noexcept : samples_(std::clamp(samples, 1, kMax)) {}

  T Update(const T& value) noexcept {
    ring_[static_cast<std::size_t>(next_)] = value;
    next_ = (next_ + 1) % samples_;
    count_ = std::min(count_ + 1, samples_);
    T sum = ring_[0];
    for (int i = 1; i < count_; ++i) sum += ring_[static_cast<std::size_t>(i)];
    return sum / static_cast<double>(count_);
  }

 private:
  std::array<T, kMax> ring_{};
  int samples_;
  int next_ = 0, count_ = 0;
};

}  // namespace scoria::core
