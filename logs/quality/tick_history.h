// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>

#include "logs/quality/tick.h"

namespace scoria::logs {

/// The last kSize ticks without an interruption.
template <std::size_t kSize>
class TickHistory {
 public:
  void Add(const Tick& tick) {
    if (tick.is_first) count_ = 0;
    ticks_[next_] = tick;
    next_ = (next_ + 1) % kSize;
    if (count_ < kSize) ++count_;
  }
  [[nodiscard]] bool IsFull() const noexcept { return count_ == kSize; }
  /// 0 is the oldest. @pre IsFull()
  [[nodiscard]] const Tick& operator[](std::size_t i) const noexcept {
    return ticks_[(next_ + i) % kSize];
  }

 private:
  std::array<Tick, kSize> ticks_;
  std::size_t next_ = 0, count_ = 0;
};

}  // namespace scoria::logs
