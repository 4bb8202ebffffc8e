// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/falls.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

constexpr double kNominal_m = 0.3;

FallSample Upright() { return {.tilt_rad = 0.0, .height_m = 0.3, .trunk_force_N = 0.0}; }
FallSample Pressed() { return {.tilt_rad = 0.0, .height_m = 0.3, .trunk_force_N = 50.0}; }
FallSample Low() { return {.tilt_rad = 0.0, .height_m = 0.1, .trunk_force_N = 0.0}; }
FallSample Tilted() { return {.tilt_rad = 1.1, .height_m = 0.3, .trunk_force_N = 0.0}; }

FallCause RunFor(FallDetector& detector, FallSample sample, double seconds, double dt_s = 0.001) {
  sample.dt_s = dt_s;
  for (long i = 0; i < std::lround(seconds / dt_s); ++i) {
    const FallCause cause = detector.Update(sample);
    if (cause != FallCause::kNone) return cause;
  }
  return FallCause::kNone;
}

TEST(Falls, TrunkMustBearForceForATenthOfASecond) {
  FallDetector detector({}, kNominal_m);
  EXPECT_EQ(RunFor(detector, Pressed(), 0.09), FallCause::kNone);
  EXPECT_EQ(RunFor(detector, Upright(), 0.01), FallCause::kNone);  // relief starts the clock again
  EXPECT_EQ(RunFor(detector, Pressed(), 0.09), FallCause::kNone);
  EXPECT_EQ(RunFor(detector, Pressed(), 0.05), FallCause::kTrunkContact);
}

TEST(Falls, TiltCountsAtOnceAndLowAfterAWhile) {
  FallDetector detector({}, kNominal_m);
  EXPECT_EQ(RunFor(detector, Low(), 0.19), FallCause::kNone);
  EXPECT_EQ(detector.state(), FallState::kStumbling);
  EXPECT_EQ(RunFor(detector, Low(), 0.05), FallCause::kLow);
  EXPECT_EQ(detector.state(), FallState::kFallen);
  detector.Reset();
  EXPECT_EQ(RunFor(detector, Tilted(), 0.001), FallCause::kTilt);
}

// The same course at the rates of the simulator, of its rows and of slow field logs.
TEST(Falls, RateOfTheSamplesDoesNotMatter) {
  for (const double dt_s : {0.001, 0.002, 0.005, 0.02}) {
    FallDetector detector({}, kNominal_m);
    EXPECT_EQ(RunFor(detector, Upright(), 1.0, dt_s), FallCause::kNone) << dt_s;
    EXPECT_EQ(RunFor(detector, Pressed(), 0.08, dt_s), FallCause::kNone) << dt_s;
    EXPECT_EQ(RunFor(detector, Pressed(), 0.08, dt_s), FallCause::kTrunkContact) << dt_s;
  }
}

// A robot that lies is one fall, until it was set on its feet or stands by itself.
TEST(Falls, FallenCountsOnceUntilUprightAgain) {
  FallDetector detector({}, kNominal_m);
  EXPECT_EQ(RunFor(detector, Tilted(), 0.1), FallCause::kTilt);
  EXPECT_EQ(RunFor(detector, Tilted(), 5.0), FallCause::kNone);
  EXPECT_EQ(RunFor(detector, Upright(), 0.9), FallCause::kNone);
  EXPECT_EQ(detector.state(), FallState::kFallen);
  EXPECT_EQ(RunFor(detector, Tilted(), 0.1), FallCause::kNone) << "it rolls over";
  EXPECT_EQ(RunFor(detector, Upright(), 1.1), FallCause::kNone);
  EXPECT_EQ(detector.state(), FallState::kUpright);
  EXPECT_EQ(RunFor(detector, Tilted(), 0.1), FallCause::kTilt);
}

TEST(Falls, WhatIsNotKnownIsNoEvidence) {
  FallDetector detector({}, kNominal_m);
  EXPECT_EQ(RunFor(detector, {}, 10.0), FallCause::kNone);
  EXPECT_EQ(detector.state(), FallState::kUpright);
  FallSample only_tilt;
  only_tilt.tilt_rad = 1.1;
  EXPECT_EQ(RunFor(detector, only_tilt, 0.1), FallCause::kTilt);
}

TEST(Falls, BeforeTheControllerIsInChargeTiltAndNotStandingCount) {
  FallDetector detector({}, kNominal_m);
  FallSample folded{.dt_s = 0.001, .tilt_rad = 0.0, .height_m = 0.07, .trunk_force_N = 100.0};
  EXPECT_EQ(detector.UpdateStandUp(folded, -1.0), FallCause::kNone);
  EXPECT_EQ(detector.UpdateStandUp(folded, 2.9), FallCause::kNone);
  EXPECT_EQ(detector.UpdateStandUp(folded, 3.1), FallCause::kNotStanding);
  detector.Reset();
  folded.tilt_rad = 1.1;
  EXPECT_EQ(detector.UpdateStandUp(folded, -1.0), FallCause::kTilt);
}

}  // namespace
}  // namespace scoria::analysis
