// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/foot_sensor.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/rng.h"
#include "tests/support/trot.h"

namespace scoria::controller {
namespace {

using test::kStep_s;
using test::Ticks;
using test::Trot;

TEST(FootSensor, HysteresisHoldsAgainstNoise) {
  const FootSensorParams params;
  FootSensor sensor(params, kStep_s);
  const double threshold = params.initial_threshold_counts, half = 0.5 * params.hysteresis_counts;
  EXPECT_FALSE(sensor.Update(threshold + half, false));
  EXPECT_TRUE(sensor.Update(threshold + 3.0 * half, false));
  EXPECT_TRUE(sensor.Update(threshold - half, false));
  EXPECT_FALSE(sensor.Update(threshold - 3.0 * half, false));
}

TEST(FootSensor, ThresholdFollowsTheReadingInTheAir) {
  const FootSensorParams params;
  FootSensor sensor(params, kStep_s);
  for (int i = 0; i < Ticks(2.0); ++i) {
    const bool air = i % Ticks(0.5) < Ticks(0.2);
    (void)sensor.Update(air ? 30.0 : 90.0, air);
  }
  EXPECT_DOUBLE_EQ(sensor.threshold_counts(), 30.0 + params.margin_counts);
  ASSERT_TRUE(sensor.zero_counts());
  EXPECT_DOUBLE_EQ(*sensor.zero_counts(), 30.0);
}

TEST(FootSensor, StandingForAMinuteStaysContact) {
  core::Rng rng(1, 0, core::Stream::kSensor);
  FootSensor sensor({}, kStep_s);
  for (int i = 0; i < Ticks(0.5); ++i) (void)sensor.Update(12.0, true);
  for (int i = 0; i < Ticks(60.0); ++i) {
    ASSERT_TRUE(sensor.Update(60.0 + 4.0 * rng.NextNormal(), false)) << i;
  }
}

TEST(FootSensor, HangingForAMinuteStaysAir) {
  core::Rng rng(1, 0, core::Stream::kSensor);
  FootSensor sensor({}, kStep_s);
  for (int i = 0; i < Ticks(60.0); ++i) {
    ASSERT_FALSE(sensor.Update(12.0 + std::round(0.5 * rng.NextNormal()), true)) << i;
  }
}

TEST(FootSensor, ReadingThatIsNotFiniteIsNoContactAndForgotten) {
  FootSensor sensor({}, kStep_s);
  EXPECT_TRUE(sensor.Update(80.0, false));
  EXPECT_FALSE(sensor.Update(std::numeric_limits<double>::quiet_NaN(), false));
  EXPECT_TRUE(sensor.Update(80.0, false));
}

// --- Health -------------------------------------------------------------------------------------

double Stuck(double, double) { return 37.0; }
double Dropout(double, double) { return 0.0; }
double NotANumber(double, double) { return std::numeric_limits<double>::quiet_NaN(); }
double Packed(double counts, double) { return std::max(counts, 45.0) + counts / 16.0; }
double FastDrift(double counts, double since_s) { return counts + 100.0 * since_s; }
double SlowDrift(double counts, double since_s) { return counts + 1.0 * since_s; }

TEST(SensorHealth, CountsThatRestInTheAirAreNotStuck) {
  Trot trot;
  trot.noise_counts = 0.0;
  for (int i = 0; i < Ticks(20.0); ++i) {
    const ContactEstimate& out = trot.Step();
    for (const Leg leg : kLegs) ASSERT_TRUE(out.sensor_healthy[leg]) << i;
  }
}

TEST(SensorHealth, FaultsAreNoticedWithinHalfASecondAndOnThatFootOnly) {
  for (const Trot::Fault fault : {Stuck, Dropout, NotANumber, Packed, FastDrift}) {
    for (const double start_s : {3.0, 3.1, 3.2, 3.3, 3.4}) {
      Trot trot;
      trot.Run(start_s);
      trot.fault = fault;
      EXPECT_LT(trot.TimeUntilHealth(false, 1.0), 0.5) << start_s;
      for (int i = 0; i < Ticks(2.0); ++i) {
        const ContactEstimate& out = trot.Step();
        ASSERT_EQ(out.source[Leg::kFL], ContactSource::kObserver);
        for (const Leg leg : {Leg::kFR, Leg::kHL, Leg::kHR}) {
          ASSERT_EQ(out.source[leg], ContactSource::kSensor);
        }
      }
    }
  }
}

TEST(SensorHealth, SlowDriftIsFollowedUntilItsLimit) {
  const HealthParams params;
  Trot trot;
  trot.Run(3.0);
  trot.fault = SlowDrift;
  const double limit_s = params.drift_counts;  // at one count a second
  EXPECT_NEAR(trot.TimeUntilHealth(false, 2.0 * limit_s), limit_s, 2.0);
}

TEST(SensorHealth, SensorReturnsAfterAgreementAndTime) {
  const HealthParams params;
  Trot trot;
  trot.Run(3.0);
  trot.fault = Dropout;
  trot.Run(1.0);
  trot.fault = nullptr;
  const double back_s = trot.TimeUntilHealth(true, 20.0);
  EXPECT_GE(back_s, params.recover_s - kStep_s);
  // The window of least readings must forget the fault's zeros first.
  EXPECT_LT(back_s, FootSensorParams{}.min_window_s + params.recover_s + Trot::kPeriod_s);
  EXPECT_EQ(trot.out().source[Leg::kFL], ContactSource::kSensor);
}

TEST(SensorHealth, SensorDoesNotReturnWithoutSteps) {
  Trot trot;
  trot.Run(3.0);
  trot.fault = Packed;
  trot.Run(1.0);
  trot.fault = nullptr;
  trot.standing = true;
  EXPECT_GE(trot.TimeUntilHealth(true, 20.0), 20.0 - kStep_s);
}

TEST(SensorHealth, StandingForAMinuteStaysHealthyContact) {
  Trot trot;
  trot.standing = true;
  for (int i = 0; i < Ticks(60.0); ++i) {
    const ContactEstimate& out = trot.Step();
    for (const Leg leg : kLegs) ASSERT_TRUE(out.contact[leg] && out.sensor_healthy[leg]) << i;
  }
}

}  // namespace
}  // namespace scoria::controller
