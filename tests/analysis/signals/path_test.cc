// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/path.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

constexpr double kStep_s = 0.001;

TEST(PathLength, SwayWithinAChordIsNoWay) {
  constexpr double kSpeed_mps = 0.4, kSway_m = 0.05, kSway_Hz = 4.0;
  PathLength path;
  for (int i = 0; i <= 10000; ++i) {
    const double t_s = kStep_s * i;
    path.Add(
        {kStep_s, {kSpeed_mps * t_s, kSway_m * std::sin(2.0 * std::numbers::pi * kSway_Hz * t_s)}});
  }
  EXPECT_NEAR(path.length_m(), 4.0, 0.01);
}

TEST(PathLength, ChordThatEndsEarlyCountsAndCarryingDoesNot) {
  PathLength path;
  path.Add({kStep_s, {0.0, 0.0}});
  path.CloseChord({0.03, 0.04});
  EXPECT_DOUBLE_EQ(path.length_m(), 0.05);
  path.CloseChord({1.0, 0.0});
  EXPECT_DOUBLE_EQ(path.length_m(), 0.05) << "there is no chord";
  path.Add({kStep_s, {0.0, 0.0}});
  path.Lift();
  path.Add({kStep_s, {7.0, 0.0}});
  path.CloseChord({7.1, 0.0});
  EXPECT_NEAR(path.length_m(), 0.15, 1e-12);
}

// Chords are half a second long whatever the rate of the samples: the way of a walk on a circle is
// that of its polygon.
TEST(PathLength, RateOfTheSamplesDoesNotMatter) {
  constexpr double kRadius_m = 1.0, kTurn_radps = 0.5, kWalk_s = 10.0;
  const double polygon_m = kWalk_s / 0.5 * 2.0 * kRadius_m * std::sin(0.25 * kTurn_radps);
  for (const double dt_s : {0.001, 0.002, 0.0041, 0.02, 0.05}) {
    PathLength path;
    for (int i = 0; dt_s * i <= kWalk_s + 1e-9; ++i) {
      const double angle_rad = kTurn_radps * dt_s * i;
      path.Add({i == 0 ? 0.0 : dt_s,
                {kRadius_m * std::cos(angle_rad), kRadius_m * std::sin(angle_rad)}});
    }
    const double last_rad = kTurn_radps * kWalk_s;
    path.CloseChord({kRadius_m * std::cos(last_rad), kRadius_m * std::sin(last_rad)});
    EXPECT_NEAR(path.length_m(), polygon_m, 1e-3) << dt_s;
  }
}

TEST(PathLength, ChordsTellTheirLength) {
  PathLength path;
  EXPECT_EQ(path.Add({0.0, {0.0, 0.0}}), std::nullopt);
  EXPECT_EQ(path.Add({0.25, {1.0, 0.0}}), std::nullopt);
  EXPECT_EQ(path.Add({0.25, {3.0, 4.0}}), 5.0);
  EXPECT_EQ(path.CloseChord({3.0, 5.0}), 1.0);
  EXPECT_EQ(path.length_m(), 6.0);
}

}  // namespace
}  // namespace scoria::analysis
