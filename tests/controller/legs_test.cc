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
  return machine.Update(plan, contact, 0.0, 0.002).mode[Leg::kFL];
}

struct Transition {
  const char* name;
  LateContact late;
  bool early_enabled, planned_stance, touching;
  double remaining_s;
  LegMode expected;
};

// From swing.
TEST(LegStateMachine, LeavesSwingByTheTable) {
  const Transition table[] = {
      {"still swinging", LateContact::kStance, true, false, false, 0.1, LegMode::kSwing},
      {"touch in the first half is a stumble, not stance", LateContact::kStance, true, false, true,
       0.15, LegMode::kSwing},
      {"touch in the second half", LateContact::kStance, true, false, true, 0.05,
       LegMode::kEarlyContact},
      {"early contact switched off", LateContact::kStance, false, false, true, 0.05,
       LegMode::kSwing},
      {"due and touching", LateContact::kLower, true, true, true, 0.0, LegMode::kStance},
      {"due, in the air, stance at once", LateContact::kStance, true, true, false, 0.0,
       LegMode::kStance},
      {"due, in the air, lowered", LateContact::kLower, true, true, false, 0.0,
       LegMode::kLateContact},
  };
  for (const Transition& t : table) {
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
  params.late_contact = LateContact::kLower;
  LegStateMachine machine(params);
  (void)Feed(machine, PlanFor(false, 0.01), false);
  EXPECT_EQ(Feed(machine, PlanFor(true), false), LegMode::kLateContact);
  EXPECT_EQ(Feed(machine, PlanFor(true), false), LegMode::kLateContact);
  EXPECT_NEAR(machine.Update(PlanFor(true), LegArray<bool>(false), 0.0, 0.002).late_s[Leg::kFL],
              0.006, 1e-12);
  EXPECT_EQ(Feed(machine, PlanFor(true), true), LegMode::kStance);
  EXPECT_EQ(Feed(machine, PlanFor(true), false), LegMode::kStance)
      << "a foot that has stood is not late again";
}

}  // namespace
}  // namespace scoria::controller
