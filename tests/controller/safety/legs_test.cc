// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "controller/safety/leg_state_machine.h"

namespace scoria::controller {
namespace {

/// A plan in which FL is in stance or swings with `remaining_s` of 0.2 s to go; the others stand.
ContactPlan PlanFor(bool stance, double remaining_s = 0.2) {
  ContactPlan plan;
  plan.stance = LegArray<bool>(true);
  plan.swing_s = LegArray<double>(0.2);
  plan.stance[Leg::kFL] = stance;
  plan.swing_remaining_s[Leg::kFL] = stance ? 0.0 : remaining_s;
  return plan;
}

LegMode Feed(LegStateMachine& machine, const ContactPlan& plan, bool touching) {
  LegArray<bool> contact(true);
  contact[Leg::kFL] = touching;
  Counters counters;
  return machine.Update(plan, contact, 0.0, 0.002, counters).mode[Leg::kFL];
}

struct LegTransition {
  const char* name;
  AirborneFoot late;
  bool early_enabled, planned_stance, touching;
  double remaining_s;
  LegMode expected;
};

// From swing.
TEST(LegStateMachine, LeavesSwingByTheTable) {
  const LegTransition table[] = {
      {"still swinging", AirborneFoot::kStance, true, false, false, 0.1, LegMode::kSwing},
      {"touch in the first half is a stumble, not stance", AirborneFoot::kStance, true, false, true,
       0.15, LegMode::kSwing},
      {"touch in the second half", AirborneFoot::kStance, true, false, true, 0.05,
       LegMode::kEarlyContact},
      {"early contact switched off", AirborneFoot::kStance, false, false, true, 0.05,
       LegMode::kSwing},
      {"due and touching", AirborneFoot::kLower, true, true, true, 0.0, LegMode::kStance},
      {"due, in the air, stance at once", AirborneFoot::kStance, true, true, false, 0.0,
       LegMode::kStance},
      {"due, in the air, lowered", AirborneFoot::kLower, true, true, false, 0.0,
       LegMode::kLowering},
  };
  for (const LegTransition& t : table) {
    LegStateParams params;
    params.late_contact = t.late;
    params.early_contact = t.early_enabled;
    LegStateMachine machine(params);
    ASSERT_EQ(Feed(machine, PlanFor(false, 0.2), false), LegMode::kSwing);
    EXPECT_EQ(Feed(machine, PlanFor(t.planned_stance, t.remaining_s), t.touching), t.expected)
        << t.name;
  }
}

TEST(LegStateMachine, EarlyContactHoldsUntilItsStanceAndThenSwingsAgain) {
  LegStateMachine machine{LegStateParams{}};
  (void)Feed(machine, PlanFor(false, 0.2), false);
  EXPECT_EQ(Feed(machine, PlanFor(false, 0.05), true), LegMode::kEarlyContact);
  EXPECT_EQ(Feed(machine, PlanFor(false, 0.02), false), LegMode::kEarlyContact);
  EXPECT_EQ(Feed(machine, PlanFor(true), true), LegMode::kStance);
  EXPECT_EQ(Feed(machine, PlanFor(false, 0.2), true), LegMode::kSwing);
}

TEST(LegStateMachine, LateFootWaitsUntilItTouchesOrSwingsAgain) {
  LegStateParams params;
  params.late_contact = AirborneFoot::kLower;
  LegStateMachine machine(params);
  (void)Feed(machine, PlanFor(false, 0.01), false);
  EXPECT_EQ(Feed(machine, PlanFor(true), false), LegMode::kLowering);
  EXPECT_EQ(Feed(machine, PlanFor(true), false), LegMode::kLowering);
  Counters counters;
  EXPECT_NEAR(
      machine.Update(PlanFor(true), LegArray<bool>(false), 0.0, 0.002, counters).late_s[Leg::kFL],
      0.006, 1e-12);
  EXPECT_EQ(Feed(machine, PlanFor(true), true), LegMode::kStance);
  EXPECT_EQ(Feed(machine, PlanFor(true), false), LegMode::kStance)
      << "a foot that has stood is not late again";
}

TEST(LegStateMachine, LateFootIsHeldOrLoweredAsAsked) {
  for (const auto& [late, expected] : {std::pair{AirborneFoot::kHold, LegMode::kHolding},
                                       std::pair{AirborneFoot::kLower, LegMode::kLowering}}) {
    LegStateParams params;
    params.late_contact = late;
    LegStateMachine machine(params);
    (void)Feed(machine, PlanFor(false, 0.01), false);
    EXPECT_EQ(Feed(machine, PlanFor(true), false), expected);
    EXPECT_EQ(Feed(machine, PlanFor(false, 0.2), false), LegMode::kSwing)
        << "its next swing is due";
    EXPECT_EQ(Feed(machine, PlanFor(true), true), LegMode::kStance);
  }
}

TEST(LegStateMachine, ContactIsLostAfterAWhileInTheAirIfThereWasOne) {
  LegStateParams params;
  params.lost_contact = AirborneFoot::kLower;
  params.lost_after_s = 0.005;
  LegStateMachine machine(params);
  Counters counters;
  const auto feed = [&](bool stance, bool touching) {
    LegArray<bool> contact(true);
    contact[Leg::kFL] = touching;
    return machine.Update(PlanFor(stance), contact, 0.0, 0.002, counters).mode[Leg::kFL];
  };
  EXPECT_EQ(feed(true, false), LegMode::kStance) << "it has not touched yet";
  for (int i = 0; i < 10; ++i) EXPECT_EQ(feed(true, false), LegMode::kStance);
  EXPECT_EQ(feed(true, true), LegMode::kStance);
  for (int i = 0; i < 2; ++i) EXPECT_EQ(feed(true, false), LegMode::kStance);
  EXPECT_EQ(feed(true, false), LegMode::kLowering);
  EXPECT_EQ(feed(true, false), LegMode::kLowering);
  EXPECT_EQ(feed(true, true), LegMode::kStance);
  EXPECT_EQ(counters[Count::kLostContact], 1u);
}

TEST(LegStateMachine, StumblesInTheFirstHalfOfASwing) {
  LegStateParams params;
  params.stumble_reflex = true;
  LegStateMachine machine(params);
  (void)Feed(machine, PlanFor(false, 0.2), false);
  EXPECT_EQ(Feed(machine, PlanFor(false, 0.19), true), LegMode::kSwing)
      << "still leaving the ground";
  EXPECT_EQ(Feed(machine, PlanFor(false, 0.15), true), LegMode::kStumble);
  EXPECT_EQ(Feed(machine, PlanFor(false, 0.12), false), LegMode::kStumble) << "until it ends";
  EXPECT_EQ(Feed(machine, PlanFor(false, 0.05), true), LegMode::kEarlyContact);
  EXPECT_EQ(Feed(machine, PlanFor(true), true), LegMode::kStance);
}

}  // namespace
}  // namespace scoria::controller
