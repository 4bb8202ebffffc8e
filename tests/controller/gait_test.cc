// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "controller/gait/gait_sequencer.h"
#include "core/rng.h"

namespace scoria::controller {
namespace {

GaitInput Walking(double v) {
  GaitInput in;
  in.command.v_x_mps = v;
  in.v_xy_mps = v;
  in.height_m = 0.30;
  return in;
}

/// Phase distance in [-0.5, 0.5).
double Wrapped(double x) { return x - std::floor(x + 0.5); }

// Table of the reference (gait_and_cost_of_transport.md): h = 0.30 m, g = 9.81.
TEST(StrideLaw, GivesTheTabulatedPeriodsAndDutyFactors) {
  StrideLaw law;
  law.max_stance_travel_m = 10.0;  // the table has no cap
  struct Case {
    double v, T, d;
  };
  for (const Case& c : {Case{0.05, 1.654, 0.879}, Case{0.3, 0.808, 0.752}, Case{0.5, 0.659, 0.696},
                        Case{1.0, 0.499, 0.599}}) {
    const GaitTiming t = law.Timing(c.v, 0.30);
    EXPECT_NEAR(t.period_s, c.T, 2e-3);
    EXPECT_NEAR(t.duty, c.d, 2e-3);
  }
}

TEST(StrideLaw, CapsStanceTravelAndSurvivesStandingAndSprinting) {
  StrideLaw law;
  const GaitTiming fast = law.Timing(2.0, 0.30), still = law.Timing(0.0, 0.30);
  EXPECT_GE(fast.duty, law.min_duty - 1e-12);
  EXPECT_LE(still.duty, law.max_duty + 1e-12);
  EXPECT_TRUE(std::isfinite(still.period_s));
  law.gravity_mps2 = 1.62;  // the Moon: long strides
  const GaitTiming moon = law.Timing(0.5, 0.30);
  EXPECT_LE(0.5 * moon.duty * moon.period_s, law.max_stance_travel_m + 1e-9);
}

TEST(SimpleGait, TrotsInDiagonalPairsWithItsDutyFactor) {
  const auto gait = MakeGaitSequencer(SgsParams{}, 0.30);
  LegArray<int> stance(0);
  constexpr int kTicks = 1000;  // twenty periods
  for (int i = 0; i < kTicks; ++i) {
    const ContactPlan plan = gait->Plan(Walking(0.3));
    EXPECT_EQ(plan.stance[Leg::kFL], plan.stance[Leg::kHR]);
    EXPECT_EQ(plan.stance[Leg::kFR], plan.stance[Leg::kHL]);
    EXPECT_TRUE(plan.stance[Leg::kFL] || plan.stance[Leg::kFR]);
    for (const Leg leg : kLegs) stance[leg] += plan.stance[leg] ? 1 : 0;
  }
  for (const Leg leg : kLegs) EXPECT_NEAR(stance[leg] / double{kTicks}, 0.6, 0.02);
}

TEST(SimpleGait, StandsWithoutACommandAndFinishesSwingsBeforeStanding) {
  const auto gait = MakeGaitSequencer(SgsParams{}, 0.30);
  EXPECT_TRUE(gait->Plan(Walking(0.0)).standing);
  for (int i = 0; i < 37; ++i) (void)gait->Plan(Walking(0.3));
  ContactPlan plan;
  LegArray<bool> before(false);
  for (int i = 0; i < 60; ++i) {
    plan = gait->Plan(Walking(0.0));
    for (const Leg leg : kLegs) {
      EXPECT_FALSE(before[leg] && !plan.stance[leg]) << "no foot lifts after the stop";
      before[leg] = plan.stance[leg];
    }
  }
  EXPECT_TRUE(plan.standing);
}

TEST(Plan, PredictsTheStagesThatTheClockThenReaches) {
  const auto gait = MakeGaitSequencer(SgsParams{}, 0.30);
  for (int i = 0; i < 13; ++i) (void)gait->Plan(Walking(0.3));
  GaitInput in = Walking(0.3);
  const ContactPlan plan = gait->Plan(in);
  for (int k = 1; k < plan.horizon; ++k) {
    ContactPlan later;
    for (int tick = 0; tick < 5; ++tick) later = gait->Plan(in);  // 5 x 10 ms = one stage
    EXPECT_EQ(later.stance, plan.stage_stance[static_cast<std::size_t>(k)]) << k;
  }
}

TEST(Plan, SwingTimesCountDownToTouchdown) {
  const auto gait = MakeGaitSequencer(AgsParams{}, 0.30);
  double last = 0.0;
  for (int i = 0; i < 300; ++i) {
    const ContactPlan plan = gait->Plan(Walking(0.4));
    const double remaining = plan.swing_remaining_s[Leg::kFL];
    EXPECT_EQ(remaining == 0.0, plan.stance[Leg::kFL]);
    EXPECT_NEAR(plan.swing_s[Leg::kFL], 0.2, 1e-9);  // constant swing time
    if (last > 0.0 && remaining > 0.0) {
      EXPECT_LT(remaining, last);
    }
    last = remaining;
  }
}

// Whatever the speed does, phases stay in [0, 1), contacts change only at lift-off and touchdown,
// and the trot's offsets come back within two cycles once the speed is steady.
TEST(AdaptiveGait, KeepsContactsConsistentForRandomSpeeds) {
  core::Rng rng(1, 0, core::Stream::kOperator);
  for (int profile = 0; profile < 30; ++profile) {
    const auto gait = MakeGaitSequencer(AgsParams{}, 0.30);
    double v = 0.3;
    LegArray<double> phase(0.0);
    LegArray<bool> stance(true);
    ContactPlan plan;
    for (int i = 0; i < 1500; ++i) {
      if (i % 50 == 0 && i < 1000) v = rng.NextUniform(0.02, 2.0);
      GaitInput in = Walking(v);
      in.w_z_radps = i < 1000 ? rng.NextUniform(-1.0, 1.0) : 0.0;
      plan = gait->Plan(in);
      for (const Leg leg : kLegs) {
        EXPECT_GE(plan.phase[leg], 0.0);
        EXPECT_LT(plan.phase[leg], 1.0);
        EXPECT_EQ(plan.stance[leg], plan.phase[leg] < plan.duty[leg]);
        EXPECT_FALSE(i > 0 && stance[leg] && !plan.stance[leg] && phase[leg] < 0.3)
            << "no lift-off out of early stance";
        EXPECT_FALSE(i > 0 && !stance[leg] && plan.stance[leg] && plan.phase[leg] > 0.5)
            << "stance starts at its start";
      }
      phase = plan.phase;
      stance = plan.stance;
    }
    for (const Leg leg : kLegs) {
      const double offset = plan.phase[Leg::kFL] + plan.offset[Leg::kFL] - plan.phase[leg];
      EXPECT_NEAR(Wrapped(offset - plan.offset[leg]), 0.0, 0.03) << "profile " << profile;
    }
  }
}

TEST(AdaptiveGait, EarlyTouchdownEndsTheSwing) {
  const auto gait = MakeGaitSequencer(AgsParams{}, 0.30);
  GaitInput in = Walking(0.5);
  ContactPlan plan = gait->Plan(in);
  const auto progress = [&] {
    return 1.0 - plan.swing_remaining_s[Leg::kFR] / plan.swing_s[Leg::kFR];
  };
  while (plan.stance[Leg::kFR] || progress() < 0.6) plan = gait->Plan(in);
  in.early_contact[Leg::kFR] = true;
  plan = gait->Plan(in);
  EXPECT_TRUE(plan.stance[Leg::kFR]);
  EXPECT_LT(plan.phase[Leg::kFR], 0.05);
}

TEST(MatchedGait, IgnoresTheMeasuredSpeed) {
  const auto gait = MakeGaitSequencer(SgsMatchedParams{}, 0.30);
  GaitInput in = Walking(0.5);
  const double period = gait->Plan(in).period_s;
  in.v_xy_mps = 1.4;
  EXPECT_EQ(gait->Plan(in).period_s, period);
  EXPECT_NEAR(period, 0.659, 2e-3);
}

}  // namespace
}  // namespace scoria::controller
