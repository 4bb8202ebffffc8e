// SPDX-License-Identifier: BSD-3-Clause
#include "core/rng.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scoria::core {
namespace {

/// Coefficients from that of x⁰ upwards.
double Polynomial(const std::array<double, 8>& coefficients, double x) noexcept {
  double sum = 0.0;
  for (std::size_t i = coefficients.size(); i > 0; --i) sum = sum * x + coefficients[i - 1];
  return sum;
}

}  // namespace

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

// Its third range, below p = 1.4e-11, is out of reach of 32 bits.
// Source: [Wichura1988], algorithm AS 241, PPND16.
double Rng::NextQuickNormal() noexcept {
  constexpr std::array<double, 8> kCentreTop = {
      3.387132872796366608,  133.14166789178437745, 1971.5909503065514427, 13731.693765509461125,
      45921.953931549871457, 67265.770927008700853, 33430.575583588128105, 2509.0809287301226727};
  constexpr std::array<double, 8> kCentreBottom = {1.0,
                                                   42.313330701600911252,
                                                   687.1870074920579083,
                                                   5394.1960214247511077,
                                                   21213.794301586595867,
                                                   39307.89580009271061,
                                                   28729.085735721942674,
                                                   5226.495278852545925};
  constexpr std::array<double, 8> kTailTop = {1.42343711074968357734,   4.6303378461565452959,
                                              5.7694972214606914055,    3.64784832476320460504,
                                              1.27045825245236838258,   0.24178072517745061177,
                                              0.0227238449892691845833, 7.7454501427834140764e-4};
  constexpr std::array<double, 8> kTailBottom = {1.0,
                                                 2.05319162663775882187,
                                                 1.6763848301838038494,
                                                 0.68976733498510000455,
                                                 0.14810397642748007459,
                                                 0.0151986665636164571966,
                                                 5.475938084995344946e-4,
                                                 1.05075007164441684324e-9};
  constexpr double kCentre = 0.425, kTailStart = 1.6;
  const double p = (NextU32() + 0.5) * 0x1.0p-32, q = p - 0.5;
  if (std::abs(q) <= kCentre) {
    const double r = kCentre * kCentre - q * q;
    return q * Polynomial(kCentreTop, r) / Polynomial(kCentreBottom, r);
  }
  const double r = std::sqrt(-std::log(std::min(p, 1.0 - p))) - kTailStart;
  return std::copysign(Polynomial(kTailTop, r) / Polynomial(kTailBottom, r), q);
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
