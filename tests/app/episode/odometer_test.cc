// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/odometer.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scoria::app {
namespace {

constexpr double kStep_s = 0.001;

TEST(Odometer, SwayWithinAChordIsNoWay) {
  constexpr double kSpeed_mps = 0.4, kSway_m = 0.05, kSway_Hz = 4.0;
  Odometer odometer;
  for (int i = 0; i <= 10000; ++i) {
    const double t_s = kStep_s * i;
    odometer.Update({kSpeed_mps * t_s, kSway_m * std::sin(2.0 * std::numbers::pi * kSway_Hz * t_s)},
                    kStep_s);
  }
  EXPECT_NEAR(odometer.walked_m(), 4.0, 0.01);
}

TEST(Odometer, ChordThatEndsEarlyCountsAndCarryingDoesNot) {
  Odometer odometer;
  odometer.Update({0.0, 0.0}, kStep_s);
  odometer.CloseChord({0.03, 0.04});
  EXPECT_DOUBLE_EQ(odometer.walked_m(), 0.05);
  odometer.CloseChord({1.0, 0.0});
  EXPECT_DOUBLE_EQ(odometer.walked_m(), 0.05) << "there is no chord";
  odometer.Update({0.0, 0.0}, kStep_s);
  odometer.Lift();
  odometer.Update({7.0, 0.0}, kStep_s);
  odometer.CloseChord({7.1, 0.0});
  EXPECT_NEAR(odometer.walked_m(), 0.15, 1e-12);
}

}  // namespace
}  // namespace scoria::app
