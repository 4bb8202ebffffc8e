// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace scoria::analysis {

/// Counts in a fixed number of bins, so that a day of walking takes no more room than a minute.
template <std::size_t N>
struct BinCounts {
  std::array<std::uint64_t, N> counts{};

  [[nodiscard]] std::uint64_t Total() const noexcept {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : counts) sum += n;
    return sum;
  }
  BinCounts& operator+=(const BinCounts& other) noexcept {
    for (std::size_t i = 0; i < N; ++i) counts[i] += other.counts[i];
    return *this;
  }
  bool operator==(const BinCounts&) const = default;
};

}  // namespace scoria::analysis
