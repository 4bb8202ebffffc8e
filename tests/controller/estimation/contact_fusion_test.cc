// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/contact_fusion.h"

#include <gtest/gtest.h>

namespace scoria::controller {
namespace {

TEST(CalcPhaseProbability, IsPeriodicAndHalfAtTheTransitions) {
  constexpr double kDuty = 0.6, kSigma = 0.04;
  EXPECT_NEAR(CalcPhaseProbability(0.0, kDuty, kSigma), 0.5, 1e-6);
  EXPECT_NEAR(CalcPhaseProbability(kDuty, kDuty, kSigma), 0.5, 1e-6);
  EXPECT_NEAR(CalcPhaseProbability(1.0 - 1e-12, kDuty, kSigma), 0.5, 1e-6);
  EXPECT_NEAR(CalcPhaseProbability(0.3, kDuty, kSigma), 1.0, 1e-6);
  EXPECT_NEAR(CalcPhaseProbability(0.8, kDuty, kSigma), 0.0, 1e-6);
  EXPECT_EQ(CalcPhaseProbability(0.8, 1.0, kSigma), 1.0);
}

TEST(CalcContactProbability, ForceOutweighsPhaseAndHeightTogether) {
  const FusionParams params;
  const double above = 0.5 + params.hysteresis, below = 0.5 - params.hysteresis;
  FusionInput in;
  in.phase = 0.8;
  in.duty = 0.6;
  in.height_m = 0.1;
  in.force = 0.3;
  EXPECT_GT(CalcContactProbability(params, in), above) << "early, on a rock";
  in.phase = 0.3;
  in.height_m = -0.1;
  in.force = 0.0;
  EXPECT_LT(CalcContactProbability(params, in), below) << "late, over a hole";
}

TEST(AdvancePhase, WrapsAndStandsWithoutAGait) {
  ContactPlan plan;
  EXPECT_TRUE(AdvancePhase(plan, Leg::kFL, 0.3).IsStance());
  plan.standing = false;
  plan.period_s = 0.5;
  plan.duty = LegArray<double>(0.6);
  plan.phase = LegArray<double>(0.55);
  EXPECT_TRUE(AdvancePhase(plan, Leg::kFL, 0.02).IsStance());
  EXPECT_FALSE(AdvancePhase(plan, Leg::kFL, 0.03).IsStance());
  EXPECT_TRUE(AdvancePhase(plan, Leg::kFL, 0.23).IsStance());
}

}  // namespace
}  // namespace scoria::controller
