// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "core/rng.h"
#include "terrains/generator.h"
#include "tests/support/robots.h"

namespace scoria::terrains {
namespace {

TerrainParams Preset(const std::string& name) {
  return core::ReadConfig<TerrainParams>(
      core::LoadConfig(test::SourcePath("terrains/" + name + ".yaml")));
}

TEST(Heightfield, InterpolatesNodesAndHasTheGradientOfItsOwnSurface) {
  constexpr int kNodes = 40;
  core::Rng rng(1, 0, core::Stream::kTerrain);
  std::vector<double> heights;
  for (int i = 0; i < kNodes * kNodes; ++i) heights.push_back(rng.NextUniform());
  const Heightfield ground(kNodes, 0.1, heights, 0.5);
  EXPECT_NEAR(ground.HeightAt(ground.NodePosition(7, 9).x(), ground.NodePosition(7, 9).y()),
              ground.NodeHeight(7, 9), 1e-12);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 100; ++i) {
    const double x = rng.NextUniform(-1.7, 1.7), y = rng.NextUniform(-1.7, 1.7);
    const Vec2 g = ground.At(x, y).gradient;
    EXPECT_NEAR((ground.HeightAt(x + kStep, y) - ground.HeightAt(x - kStep, y)) / (2 * kStep),
                g.x(), 1e-6);
    EXPECT_NEAR((ground.HeightAt(x, y + kStep) - ground.HeightAt(x, y - kStep)) / (2 * kStep),
                g.y(), 1e-6);
  }
  EXPECT_EQ(ground.HeightAt(100.0, 0.0),
            ground.HeightAt(ground.half_size_m(), 0.0));  // the border continues
}

// nu(1 m) within 15 %, H within 0.08 of what was asked for, in the mean of four seeds.
TEST(Generator, SelfAffineGroundHasItsRoughnessAndExponent) {
  const TerrainParams params = Preset("self_affine");
  double nu = 0.0, hurst = 0.0;
  constexpr int kSeeds = 4;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    const TerrainStatistics s =
        MeasureTerrain(GenerateTerrain(params, static_cast<std::uint64_t>(seed), 0), params);
    nu += s.nu_1m_m / kSeeds;
    hurst += s.hurst / kSeeds;
  }
  EXPECT_NEAR(nu, params.roughness.nu_1m_m, 0.15 * params.roughness.nu_1m_m);
  EXPECT_NEAR(hurst, params.roughness.hurst, 0.08);
}

TEST(Generator, SameSeedSameBitsOtherSeedOtherGround) {
  TerrainParams params = Preset("vulcano_crater_rim");
  params.size_m = 12.8;
  EXPECT_EQ(GenerateTerrain(params, 3, 0).heights_m(), GenerateTerrain(params, 3, 0).heights_m());
  EXPECT_NE(GenerateTerrain(params, 3, 0).heights_m(), GenerateTerrain(params, 4, 0).heights_m());
}

TEST(Generator, RoughnessScaleMultipliesHeights) {
  TerrainParams params = Preset("self_affine");
  params.size_m = 12.8;
  const Heightfield one = GenerateTerrain(params, 2, 0);
  params.roughness_scale = 2.0;
  const Heightfield two = GenerateTerrain(params, 2, 0);
  for (std::size_t i = 0; i < one.heights_m().size(); i += 997)
    EXPECT_NEAR(two.heights_m()[i], 2.0 * one.heights_m()[i], 1e-12);
}

TEST(Generator, SlopeRisesAlongItsAzimuth) {
  TerrainParams params;
  params.size_m = 10.0;
  params.slope_rad = 0.2;
  params.slope_azimuth_rad = 0.5;
  const Vec2 g = GenerateTerrain(params, 1, 0).At(0.3, -0.7).gradient;
  EXPECT_NEAR(std::atan(g.norm()), 0.2, 1e-9);
  EXPECT_NEAR(std::atan2(g.y(), g.x()), 0.5, 1e-9);
}

// Rocks per 100 m^2 from the size-frequency law, integrated independently (terrain reference,
// section 1; D up to 3 m).
TEST(Rocks, CountsFollowTheSizeFrequencyLaw) {
  struct Case {
    double k, above_m, per_100m2;
  };
  for (const Case& c : {Case{0.02, 0.05, 165}, Case{0.02, 0.1, 38.9}, Case{0.069, 0.2, 35.3},
                        Case{0.176, 0.3, 40.1}, Case{0.30, 0.5, 21.0}}) {
    RockParams rocks;
    rocks.area_fraction = c.k;
    rocks.max_diameter_m = 3.0;
    EXPECT_NEAR(100.0 * RockDensity(rocks, c.above_m), c.per_100m2, 0.01 * c.per_100m2);
  }
}

}  // namespace
}  // namespace scoria::terrains
