// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace scoria::logs {

/// The unsigned integer at `data`, in the byte order given.
template <class Unsigned>
[[nodiscard]] Unsigned LoadUnsigned(const std::byte* data, bool is_big_endian) noexcept {
  Unsigned value;
  std::memcpy(&value, data, sizeof value);
  if (is_big_endian == (std::endian::native == std::endian::big)) return value;
  if constexpr (sizeof value == 8) return __builtin_bswap64(value);
  if constexpr (sizeof value == 4) return __builtin_bswap32(value);
  if constexpr (sizeof value == 2) return __builtin_bswap16(value);
  return value;
}

}  // namespace scoria::logs
