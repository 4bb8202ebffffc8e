// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/foothold_roughness.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace scoria::analysis {
namespace {

/// Two tracks of footholds 0.25 m apart, on ground that z tells.
FootholdRoughness WalkOver(int steps, const auto& z) {
  FootholdRoughness found;
  for (int i = 0; i < steps; ++i) {
    for (const double y : {-0.15, 0.15}) {
      const double x = 0.25 * i;
      found.Add({x, y, z(x, y)});
    }
  }
  return found;
}

TEST(FootholdRoughness, LeavesOutTheSlope) {
  const FootholdRoughness found =
      WalkOver(100, [](double x, double y) { return 0.3 * x - 0.1 * y + 2.0; });
  EXPECT_EQ(found.count(), 200u);
  ASSERT_TRUE(found.Nu_m(0.25));
  EXPECT_LT(*found.Nu_m(0.25), 1e-3);
  EXPECT_LT(*found.Nu_m(1.0), 1e-3);
}

TEST(FootholdRoughness, TakesNoHillForRoughness) {
  const FootholdRoughness hill =
      WalkOver(100, [](double x, double) { return 2.0 * std::sin(2.0 * M_PI * x / 40.0); });
  EXPECT_LT(*hill.Nu_m(0.25), 5e-3) << "slopes of 0.3 over stretches of 2 m";
  EXPECT_LT(*hill.Nu_m(1.0), 2e-2);
}

TEST(FootholdRoughness, StretchesEndAfterTwoMetresAndAtBreaks) {
  FootholdRoughness found = WalkOver(8, [](double, double) { return 0.0; });
  EXPECT_EQ(found.Stretches().size(), 1u);
  found.Add({2.25, 0.15, 0.0});
  ASSERT_EQ(found.Stretches().size(), 2u);
  EXPECT_EQ(found.Stretches()[0].size(), 16u);
  found.Break();
  found.Add({2.25, -0.15, 0.0});
  EXPECT_EQ(found.Stretches().size(), 3u);
}

TEST(FootholdRoughness, IsTheRootMeanSquareDifferenceAtTheLag) {
  core::Rng rng(3, 0, core::Stream::kTerrain);
  const FootholdRoughness white =
      WalkOver(2000, [&](double, double) { return 0.02 * rng.NextNormal(); });
  EXPECT_NEAR(*white.Nu_m(0.25), 0.02 * std::sqrt(2.0), 1e-3);
  EXPECT_NEAR(*white.Nu_m(1.0), 0.02 * std::sqrt(2.0), 4e-3) << "the plane of a stretch takes some";
  const FootholdRoughness wave =
      WalkOver(2000, [](double x, double) { return 0.05 * std::sin(2.0 * M_PI * x / 2.0); });
  EXPECT_GT(*wave.Nu_m(1.0), 1.5 * *wave.Nu_m(0.25)) << "a wave of 2 m is smooth at 0.25 m";
}

TEST(FootholdRoughness, DoesNotPairAcrossABreak) {
  FootholdRoughness found;
  for (int part = 0; part < 2; ++part) {
    for (int i = 0; i < 60; ++i) found.Add({0.25 * i, i % 2 == 0 ? 0.1 : -0.1, 10.0 * part});
    found.Break();
  }
  ASSERT_TRUE(found.Nu_m(0.25));
  EXPECT_LT(*found.Nu_m(0.25), 1e-3);
  EXPECT_FALSE(WalkOver(5, [](double, double) { return 0.0; }).Nu_m(0.25)) << "too few to tell";
}

}  // namespace
}  // namespace scoria::analysis
