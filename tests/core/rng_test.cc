// SPDX-License-Identifier: BSD-3-Clause
#include "core/rng.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scoria::core {
namespace {

// Known answers of Random123, the authors' own test vectors (kat_vectors, philox 4x32 10).
TEST(Philox, MatchesThePublishedVectors) {
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(Philox4x32({0, 0, 0, 0}, {0, 0}),
            (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(Philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Rng, StreamsAreIndependentAndRepeatable) {
  Rng a(5, 1, Stream::kTerrain), b(5, 1, Stream::kTerrain), other(5, 1, Stream::kRocks);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(a.NextU32(), b.NextU32());
  EXPECT_NE(a.NextU32(), other.NextU32());
  EXPECT_NE(Rng(5, 1, Stream::kTerrain).NextU32(), Rng(5, 2, Stream::kTerrain).NextU32());
  EXPECT_NE(Rng(5, 1, Stream::kTerrain).NextU32(), Rng(6, 1, Stream::kTerrain).NextU32());
}

TEST(Rng, MomentsAreRight) {
  Rng rng(1, 0, Stream::kSensor);
  constexpr int kDraws = 200000;
  double uniform = 0.0, mean = 0.0, square = 0.0, small = 0.0, large = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    uniform += rng.NextUniform() / kDraws;
    const double x = rng.NextNormal();
    mean += x / kDraws;
    square += x * x / kDraws;
  }
  for (int i = 0; i < 20000; ++i) {
    small += rng.NextPoisson(3.5) / 20000.0;
    large += rng.NextPoisson(2000.0) / 20000.0;
  }
  // Four standard errors each.
  EXPECT_NEAR(uniform, 0.5, 4 * 0.289 / std::sqrt(kDraws));
  EXPECT_NEAR(mean, 0.0, 4 / std::sqrt(kDraws));
  EXPECT_NEAR(square, 1.0, 4 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(small, 3.5, 4 * std::sqrt(3.5 / 20000));
  EXPECT_NEAR(large, 2000.0, 4 * std::sqrt(2000.0 / 20000));
}

// Oracle: the distribution function of the standard library.
TEST(Rng, QuickNormalInvertsTheDistributionFunction) {
  Rng quick(3, 0, Stream::kSensor), words(3, 0, Stream::kSensor);
  constexpr int kDraws = 200000;
  double mean = 0.0, square = 0.0, fourth = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = quick.NextQuickNormal();
    const double p = (words.NextU32() + 0.5) * 0x1.0p-32;
    EXPECT_NEAR(0.5 * std::erfc(-x / std::sqrt(2.0)), p, 1e-14);
    mean += x / kDraws;
    square += x * x / kDraws;
    fourth += x * x * x * x / kDraws;
  }
  // Four standard errors each.
  EXPECT_NEAR(mean, 0.0, 4 / std::sqrt(kDraws));
  EXPECT_NEAR(square, 1.0, 4 * std::sqrt(2.0 / kDraws));
  EXPECT_NEAR(fourth, 3.0, 4 * std::sqrt(96.0 / kDraws));
}

}  // namespace
}  // namespace scoria::core
