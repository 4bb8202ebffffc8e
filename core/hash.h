// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace scoria::core {

/// 64-bit FNV-1a over bytes; for identity, not for security.
class Hash64 {
 public:
  void Add(std::string_view bytes) noexcept {
    for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * kPrime;
  }
  /// The bit pattern of `n` doubles.
  void Add(const double* values, std::size_t n) noexcept;
  [[nodiscard]] std::uint64_t value() const noexcept { return value_; }

 private:
  static constexpr std::uint64_t kPrime = 1099511628211ull;
  std::uint64_t value_ = 14695981039346656037ull;
};

}  // namespace scoria::core
