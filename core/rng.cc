// SPDX-License-Identifier: BSD-3-Clause
#include "core/rng.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scoria::core {

std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> c,
                                        std::array<std::uint32_t, 2> k) noexcept {
  constexpr int kRounds = 10;
  constexpr std::uint64_t kMul0 = 0xD2511F53, kMul1 = 0xCD9E8D57;
  constexpr std::uint32_t kWeyl0 = 0x9E3779B9, kWeyl1 = 0xBB67AE85;
  for (int i = 0; i < kRounds; ++i) {
    const std::uint64_t p0 = kMul0 * c[0], p1 = kMul1 * c[2];
    c = {static_cast<std::uint32_t>(p1 >> 32) ^ c[1] ^ k[0], static_cast<std::uint32_t>(p1),
         static_cast<std::uint32_t>(p0 >> 32) ^ c[3] ^ k[1], static_cast<std::uint32_t>(p0)};
    k[0] += kWeyl0;
    k[1] += kWeyl1;
  }
  return c;
}

Rng::Rng(std::uint64_t seed, std::uint32_t episode, Stream stream) noexcept
    : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)},
      counter_{0, 0, episode, static_cast<std::uint32_t>(stream)} {}

std::uint32_t Rng::NextU32() noexcept {
  if (used_ == 4) {
    block_ = Philox4x32(counter_, key_);
    if (++counter_[0] == 0) ++counter_[1];
    used_ = 0;
  }
  return block_[static_cast<std::size_t>(used_++)];
}

double Rng::NextUniform() noexcept {
  const std::uint64_t high = NextU32() >> 5, low = NextU32() >> 6;
  return static_cast<double>((high << 26) | low) * 0x1.0p-53;
}

double Rng::NextUniform(double low, double high) noexcept {
  return low + (high - low) * NextUniform();
}

double Rng::NextNormal() noexcept {
  const double u = 1.0 - NextUniform();  // in (0, 1], so that the logarithm is finite
  const double v = NextUniform();
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

int Rng::NextPoisson(double mean) noexcept {
  constexpr double kNormalAbove = 500.0;
  if (mean > kNormalAbove) {
    return std::max(0, static_cast<int>(std::lround(mean + std::sqrt(mean) * NextNormal())));
  }
  const double limit = std::exp(-mean);
  int n = 0;
  for (double p = NextUniform(); p > limit; p *= NextUniform()) ++n;
  return n;
}

}  // namespace scoria::core
