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

/// A gait that is monitored tick by tick: phases stay in [0, 1) and move on steadily, the plan's
/// contacts are those of the phases, and feet lift only at the end of a stance and land only at the
/// end of a swing.
class CheckedGait {
 public:
  explicit CheckedGait(const GaitParams& params) : gait_(MakeGaitSequencer(params, 0.30)) {}

  const ContactPlan& Tick(const GaitInput& in) {
    const ContactPlan before = plan_;
    plan_ = gait_->Plan(in);
    for (const Leg leg : kLegs) {
      EXPECT_GE(plan_.phase[leg], 0.0);
      EXPECT_LT(plan_.phase[leg], 1.0);
      EXPECT_EQ(plan_.stance[leg], plan_.standing || plan_.phase[leg] < plan_.duty[leg]);
      EXPECT_EQ(plan_.stance[leg], plan_.stage_stance[0][leg]);
      if (ticks_ == 0 || before.standing || plan_.standing) continue;
      const double done_before = Done(before, leg), done = Done(plan_, leg);
      if (before.stance[leg] == plan_.stance[leg]) {
        // A share of the stance or swing, forwards at the clock's pace up to the offset correction.
        const double pace = in.dt_s / plan_.period_s;
        const double share = plan_.stance[leg] ? plan_.duty[leg] : 1.0 - plan_.duty[leg];
        const double correction = plan_.stance[leg] ? 0.5 * pace / share : 0.0;
        const bool may_rest = plan_.stance[leg] && in.command.IsStop();
        EXPECT_LE(done - done_before, pace / share + correction + 1e-9);
        EXPECT_GE(done - done_before, may_rest ? -1e-9 : pace / share - correction - 1e-9);
      } else {
        EXPECT_GT(done_before, 0.85) << "ends too early";
        EXPECT_LT(done, 0.15) << "starts too late";
      }
    }
    ++ticks_;
    return plan_;
  }

  /// Largest deviation of a phase offset from the one that the plan wants.
  [[nodiscard]] double OffsetError() const {
    double worst = 0.0;
    for (const Leg leg : kLegs) {
      const double offset = plan_.phase[Leg::kFL] + plan_.offset[Leg::kFL] - plan_.phase[leg];
      worst = std::max(worst, std::abs(Wrapped(offset - plan_.offset[leg])));
    }
    return worst;
  }

 private:
  static double Done(const ContactPlan& plan, Leg leg) {
    const double phase = plan.phase[leg], duty = plan.duty[leg];
    return plan.stance[leg] ? phase / duty : (phase - duty) / (1.0 - duty);
  }
  std::unique_ptr<GaitSequencer> gait_;
  ContactPlan plan_;
  int ticks_ = 0;
};

// Random speeds with stops, reversals and 2 m/s: consistent all along, and in step two cycles after
// the speed has become steady.
class RandomSpeeds : public ::testing::TestWithParam<GaitParams> {};

TEST_P(RandomSpeeds, KeepPhasesSteadyContactsConsistentAndOffsetsConverging) {
  core::Rng rng(1, 0, core::Stream::kOperator);
  for (int profile = 0; profile < 40; ++profile) {
    CheckedGait gait(GetParam());
    double v_wanted = 0.3, v = 0.0;
    GaitInput in;
    for (int i = 0; i < 1000; ++i) {
      if (i % 60 == 0) {
        const double kind = rng.NextUniform();
        v_wanted = kind < 0.2 ? 0.0 : kind < 0.4 ? -v_wanted : kind < 0.5 ? 2.0 : rng.NextUniform();
      }
      v += std::clamp(v_wanted - v, -0.03, 0.03);  // 3 m/s^2
      in = Walking(v_wanted);
      in.v_xy_mps = std::abs(v);
      in.w_z_radps = v_wanted == 0.0 ? 0.0 : rng.NextUniform(-1.0, 1.0);
      gait.Tick(in);
    }
    in = Walking(rng.NextUniform(0.05, 2.0));
    double cycles = 0.0;
    for (int i = 0; i < 30; ++i)
      cycles = 0.01 / gait.Tick(in).period_s;  // until the filter is full
    for (cycles = 0.0; cycles < 2.0;) cycles += 0.01 / gait.Tick(in).period_s;
    EXPECT_LT(gait.OffsetError(), 0.02) << "profile " << profile;
  }
}

INSTANTIATE_TEST_SUITE_P(Gaits, RandomSpeeds,
                         ::testing::Values(GaitParams(AgsParams{}), GaitParams(SgsParams{}),
                                           GaitParams(BioParams{})));

TEST(AdaptiveGait, TakesNewOffsetsThroughStanceWithinTwoCycles) {
  core::Rng rng(2, 0, core::Stream::kOperator);
  for (int trial = 0; trial < 50; ++trial) {
    CheckedGait gait(AgsParams{});
    GaitInput in = Walking(0.3);
    for (const GaitPattern pattern : {GaitPattern::kTrot, GaitPattern::kWalk, GaitPattern::kPace,
                                      GaitPattern::kTrot, GaitPattern::kPace, GaitPattern::kWalk}) {
      in.command.pattern = pattern;
      for (double cycles = 0.0; cycles < 2.0;) cycles += 0.01 / gait.Tick(in).period_s;
      EXPECT_LT(gait.OffsetError(), 0.02) << core::EnumName(pattern) << ", trial " << trial;
      const int more = static_cast<int>(rng.NextUniform(0.0, 90.0));
      for (int i = 0; i < more; ++i) gait.Tick(in);
    }
  }
}

TEST(Standing, FeetOutOfPlaceStepBackOneAtATime) {
  for (const GaitParams& params : {GaitParams(AgsParams{}), GaitParams(SgsParams{})}) {
    CheckedGait gait(params);
    GaitInput in = Walking(0.0);
    in.foot_error_m = {0.02, 0.12, 0.02, 0.10};
    LegArray<int> swing_ticks(0);
    for (int i = 0; i < 400; ++i) {
      const ContactPlan& plan = gait.Tick(in);
      int in_the_air = 0;
      for (const Leg leg : kLegs) {
        if (plan.stance[leg]) continue;
        ++in_the_air;
        ++swing_ticks[leg];
        in.foot_error_m[leg] = 0.0;  // it lands in its place
      }
      EXPECT_LE(in_the_air, 1);
    }
    EXPECT_EQ(swing_ticks[Leg::kFL] + swing_ticks[Leg::kHL], 0);
    EXPECT_NEAR(swing_ticks[Leg::kFR], 20, 1);
    EXPECT_NEAR(swing_ticks[Leg::kHR], 20, 1);
  }
}

// The reference's bands, reached and left with hysteresis, period and duty factor without a jump.
TEST(BioGait, ChangesByFroudeNumberInABlend) {
  CheckedGait gait(BioParams{});
  const auto settle = [&](double v) {
    ContactPlan plan;
    for (int i = 0; i < 300; ++i) plan = gait.Tick(Walking(v));
    return plan;
  };
  EXPECT_NEAR(settle(0.07).period_s, 0.6, 1e-9);
  EXPECT_NEAR(settle(0.3).period_s, 0.5, 1e-9);
  EXPECT_NEAR(settle(1.0).period_s, 0.4, 1e-9);
  EXPECT_NEAR(settle(0.65).period_s, 0.4, 1e-9) << "hysteresis";
  EXPECT_NEAR(settle(0.6).period_s, 0.5, 1e-9);
  const ContactPlan fast = settle(1.7);
  EXPECT_NEAR(fast.period_s, 0.3, 1e-9);
  EXPECT_NEAR(fast.duty[Leg::kFL], 0.4, 1e-9);
  double last = fast.period_s;
  for (int i = 0; i < 300; ++i) {
    const double period_s = gait.Tick(Walking(0.3)).period_s;
    EXPECT_LT(std::abs(period_s - last), 0.02);
    last = period_s;
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

// Below Fr 0.02 (0.243 m/s at 0.3 m) for longer than the delay, the legs take a walk's offsets, and
// above it a trot's again; off by default.
TEST(AdaptiveGait, WalksBelowAFroudeNumberAfterADelay) {
  AgsParams params;
  GaitInput in;
  in.height_m = 0.30;
  const auto offset_after = [&](GaitSequencer& gait, double v_mps, double seconds) {
    in.command.v_x_mps = in.v_xy_mps = v_mps;
    ContactPlan plan;
    for (int i = 0; i < std::lround(seconds / in.dt_s); ++i) plan = gait.Plan(in);
    return plan.offset;
  };
  const LegArray<double> trot{0.0, 0.5, 0.5, 0.0}, walk{0.0, 0.5, 0.75, 0.25};
  EXPECT_EQ(offset_after(*MakeGaitSequencer(params, 0.3), 0.1, 3.0), trot);
  params.slow_walk.walk_below_froude = 0.02;
  const auto gait = MakeGaitSequencer(params, 0.3);
  EXPECT_EQ(offset_after(*gait, 0.3, 2.0), trot);
  EXPECT_EQ(offset_after(*gait, 0.2, 0.5), trot) << "within the delay";
  EXPECT_EQ(offset_after(*gait, 0.2, 0.5), walk);
  EXPECT_EQ(offset_after(*gait, 0.3, 2.0), trot);
  SgsMatchedParams matched;
  matched.slow_walk.walk_below_froude = 0.02;
  EXPECT_EQ(offset_after(*MakeGaitSequencer(matched, 0.3), 0.2, 1.0), walk);
}

}  // namespace
}  // namespace scoria::controller
