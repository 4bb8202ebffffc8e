// SPDX-License-Identifier: BSD-3-Clause
#include "core/hash.h"

#include <bit>

namespace scoria::core {

void Hash64::Add(const double* values, std::size_t n) noexcept {
  for (std::size_t i = 0; i < n; ++i) {
    std::uint64_t word = std::bit_cast<std::uint64_t>(values[i]);
    for (int b = 0; b < 8; ++b, word >>= 8) value_ = (value_ ^ (word & 0xff)) * kPrime;
  }
}

}  // namespace scoria::core
