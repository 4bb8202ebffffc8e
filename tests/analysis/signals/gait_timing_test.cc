// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/gait_timing.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

/// A walk of 1 kHz: period 0.8 s, stance 0.5 s, FL, HR, FR, HL a quarter of the period apart.
logs::PerLeg<bool> Walk(double time_s) {
  constexpr double kPeriod_s = 0.8, kStance_s = 0.5;
  logs::PerLeg<bool> contact{};
  constexpr std::array<double, 4> kOffsets = {0.0, 0.5, 0.75, 0.25};
  for (std::size_t leg = 0; leg < contact.size(); ++leg) {
    const double since_s = std::fmod(time_s + kPeriod_s * (2.0 - kOffsets[leg]), kPeriod_s);
    contact[leg] = since_s < kStance_s;
  }
  return contact;
}

template <class Disturb>
GaitTiming Time(double length_s, Disturb&& disturb) {
  GaitTimer timer;
  for (int k = 0; k < static_cast<int>(1e3 * length_s); ++k) {
    logs::PerLeg<bool> contact = Walk(1e-3 * k);
    disturb(k, contact);
    timer.Add(1e-3 * k, contact);
  }
  return timer.timing();
}

void ExpectWalk(const GaitTiming& timing) {
  constexpr double kSample_s = 1e-3;
  for (const Leg leg : kLegs) {
    EXPECT_NEAR(*timing.legs[leg].MeanStride(), 0.8, kSample_s);
    EXPECT_NEAR(*timing.legs[leg].MeanStance(), 0.5, kSample_s);
    EXPECT_NEAR(*timing.legs[leg].Duty(), 0.625, 2e-3);
  }
  EXPECT_NEAR(*timing.legs[Leg::kFR].Phase(), 0.5, 2e-3);
  EXPECT_NEAR(*timing.legs[Leg::kHL].Phase(), 0.75, 2e-3);
  EXPECT_NEAR(*timing.legs[Leg::kHR].Phase(), 0.25, 2e-3);
}

TEST(GaitTimer, MeasuresStridesOfAWalk) {
  const GaitTiming timing = Time(10.0, [](int, auto&) {});
  ExpectWalk(timing);
  EXPECT_EQ(timing.legs[Leg::kFL].Regular().count, 11U);  // 12 touchdowns from 0.8 s on
}

TEST(GaitTimer, BouncesAndScuffsAreNoStrides) {
  ExpectWalk(Time(10.0, [](int k, logs::PerLeg<bool>& contact) {
    const bool in_stance = k % 800 > 100 && k % 800 < 130;
    const bool in_swing = k % 800 > 600 && k % 800 < 630;
    if (in_stance) contact[0] = false;
    if (in_swing) contact[0] = true;
  }));
}

TEST(GaitTimer, StumblesAreLeftOutOfTheMeans) {
  const GaitTiming timing = Time(20.0, [](int k, logs::PerLeg<bool>& contact) {
    const bool lost_early = k % 4000 > 200 && k % 4000 < 350;  // two strides of 0.35 and 0.45 s
    const bool not_seen = k >= 10'400 && k < 11'000;           // one of 1.6 s
    if (lost_early || not_seen) contact[0] = false;
  });
  const LegTiming& leg = timing.legs[Leg::kFL];
  EXPECT_LT(leg.Regular().count, timing.legs[Leg::kHR].Regular().count - 5);
  EXPECT_NEAR(*leg.MeanStride(), 0.8, 1e-3);
  EXPECT_NEAR(*leg.MeanStance(), 0.5, 1e-3);
}

TEST(GaitTimer, StandingIsNoStrideAndABreakEndsOne) {
  GaitTimer timer;
  for (int k = 0; k < 4000; ++k) timer.Add(1e-3 * k, {true, true, true, true});
  EXPECT_FALSE(timer.timing().legs[Leg::kFL].MeanStride());
  for (int k = 0; k < 2000; ++k) {
    if (k % 700 == 0) timer.Break();
    timer.Add(4.0 + 1e-3 * k, Walk(1e-3 * k));
  }
  EXPECT_EQ(timer.timing().legs[Leg::kFL].Regular().count, 0U);
}

TEST(GaitTiming, AddsUpOverEpisodes) {
  GaitTiming sum = Time(10.0, [](int, auto&) {});
  const GaitTiming once = sum;
  sum += once;
  EXPECT_EQ(sum.legs[Leg::kHR].Regular().count, 2 * once.legs[Leg::kHR].Regular().count);
  ExpectWalk(sum);
}

}  // namespace
}  // namespace scoria::analysis
