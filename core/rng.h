// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>

namespace scoria::core {

/// What a random stream is for. Streams are independent: one that draws more never shifts another.
enum class Stream : std::uint32_t {
  kTerrain = 1,
  kRocks,
  kMaterial,
  kSensor,
  kPayload,
  kOperator,
  kRopes,
  kGullies,
  kCraters,
  kCells,
  kRipples,
  kSolverFault,
  kImu,
  kEncoder,
  kTorqueSensor,
  kFootForce,
  kSensorFault,
  kBootstrap
};

/// Philox 4x32 with 10 rounds: a bijection of `counter` under `key`.
/// Source: [Salmon2011]; known answers in tests/core/rng_test.cc.
[[nodiscard]] std::array<std::uint32_t, 4> Philox4x32(std::array<std::uint32_t, 4> counter,
                                                      std::array<std::uint32_t, 2> key) noexcept;

/// Counter-based random numbers, keyed by (seed, episode, stream). A copy replays the same numbers.
class Rng {
 public:
  Rng(std::uint64_t seed, std::uint32_t episode, Stream stream) noexcept;

  [[nodiscard]] std::uint32_t NextU32() noexcept;
  /// Uniform in [0, 1) with 53 bits.
  [[nodiscard]] double NextUniform() noexcept;
  /// Uniform in [low, high).
  [[nodiscard]] double NextUniform(double low, double high) noexcept;
  /// Standard normal (Box-Muller, one number per call).
  [[nodiscard]] double NextNormal() noexcept;
  /// Standard normal within ±6.3, three times as fast: the inverse distribution function of one
  /// 32-bit number.
  [[nodiscard]] double NextQuickNormal() noexcept;
  /// Poisson with mean >= 0; the normal approximation above a mean of 500.
  [[nodiscard]] int NextPoisson(double mean) noexcept;

 private:
  std::array<std::uint32_t, 2> key_;
  std::array<std::uint32_t, 4> counter_;
  std::array<std::uint32_t, 4> block_{};
  int used_ = 4;  // words of block_ that are spent
};

}  // namespace scoria::core
