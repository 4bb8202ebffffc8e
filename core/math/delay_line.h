// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace scoria::core {

/// The newest values of a signal that has one per step. Allocates only when built or copied.
template <class T>
class DelayLine {
 public:
  explicit DelayLine(std::size_t longest_steps) : ring_(longest_steps + 1) {}

  void Clear() noexcept { filled_ = 0; }
  /// @returns the place of the next value, the newest from now on.
  [[nodiscard]] T& Next() noexcept {
    newest_ = newest_ + 1 == ring_.size() ? 0 : newest_ + 1;
    filled_ = std::min(filled_ + 1, ring_.size());
    return ring_[newest_];
  }
  /// The value so many steps before the newest, or the oldest since Clear if there are fewer.
  /// @pre  Next was called since the start or Clear.
  [[nodiscard]] const T& Ago(std::size_t steps) const noexcept {
    const std::size_t age = std::min(steps, filled_ - 1);
    return ring_[newest_ >= age ? newest_ - age : newest_ + ring_.size() - age];
  }
  /// Takes the next value. @returns the one of longest_steps ago.
  [[nodiscard]] const T& Pass(const T& newest) noexcept {
    Next() = newest;
    return Ago(ring_.size() - 1);
  }

 private:
  std::vector<T> ring_;
  std::size_t newest_ = 0, filled_ = 0;
};

}  // namespace scoria::core
