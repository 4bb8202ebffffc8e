// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/stuck.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

/// @returns how often a robot got stuck that walks along x, commanded to walk faster.
int CountStuck(StuckDetector& detector, double v_mps, double commanded_mps, double seconds,
               double dt_s = 0.001) {
  int stuck = 0;
  for (long i = 0; i < std::lround(seconds / dt_s); ++i)
    stuck += detector.Update({dt_s, {v_mps * dt_s * static_cast<double>(i), 0.0}, commanded_mps});
  return stuck;
}

TEST(Stuck, NeedsACommandAndTenSeconds) {
  for (const double dt_s : {0.001, 0.02}) {
    StuckDetector detector({});
    EXPECT_EQ(CountStuck(detector, 0.0, 0.3, 9.9, dt_s), 0) << dt_s;
    EXPECT_EQ(CountStuck(detector, 0.0, 0.3, 0.2, dt_s), 1) << dt_s;
    EXPECT_EQ(CountStuck(detector, 0.0, 0.0, 30.0, dt_s), 0) << dt_s;
  }
}

TEST(Stuck, SlowWalkThatKeepsItsPaceIsNone) {
  StuckDetector detector({});
  EXPECT_EQ(CountStuck(detector, 0.01, 0.01, 40.0), 0);
}

}  // namespace
}  // namespace scoria::analysis
