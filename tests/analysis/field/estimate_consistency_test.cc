// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/estimate_consistency.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scoria::analysis {
namespace {

/// A trunk that walks along x at 0.5 m/s; each foot stands for 0.2 s and lifts for 0.2 s, diagonal
/// pairs in turn, on a plane that rises by `slope`, `bump_m` higher at every other stance.
EstimateConsistency Walk(double slope, double bump_m, double foot_speed_mps) {
  ConsistencyAccumulator sums;
  constexpr double kStep_s = 0.01;
  for (int i = 0; i < 1000; ++i) {
    const int beat = i / 20;
    FeetInstant now;
    now.p_WB = Vec3(0.5 * kStep_s * i, 0.0, 0.3);
    for (const Leg leg : kLegs) {
      const bool first_pair = leg == Leg::kFL || leg == Leg::kHR;
      now.contact[leg] = (beat % 2 == 0) == first_pair;
      const double x = 0.5 * 0.2 * beat + (leg == Leg::kFL || leg == Leg::kFR ? 0.2 : -0.2);
      const double y = leg == Leg::kFL || leg == Leg::kHL ? 0.15 : -0.15;
      now.p_WF[leg] = Vec3(x, y, slope * x + (beat % 4 < 2 ? bump_m : 0.0));
      now.v_WContact[leg] = Vec3(foot_speed_mps, 0.0, 0.0);
    }
    sums.Add(now, 0);
  }
  return sums.Finish();
}

TEST(EstimateConsistency, IsNoErrorForFeetThatStandOnAPlane) {
  const EstimateConsistency found = Walk(0.2, 0.0, 0.0);
  EXPECT_EQ(found.footholds, 100u);
  EXPECT_NEAR(found.plane_rms_m, 0.0, 1e-6);
  EXPECT_EQ(found.stance_speed_rms_mps, 0.0);
  EXPECT_NEAR(found.path_m, 4.9, 0.1);
  EXPECT_NEAR(found.closure_m, 4.995, 1e-9);
}

TEST(EstimateConsistency, SeesFeetThatSlideAndFootholdsOffThePlane) {
  const EstimateConsistency found = Walk(0.0, 0.04, 0.03);
  EXPECT_NEAR(found.plane_rms_m, 0.02, 1e-3) << "half of them lie 40 mm higher";
  EXPECT_NEAR(found.stance_speed_rms_mps, 0.03, 1e-12);
}

TEST(EstimateConsistency, LaysAPlaneThroughEachSegment) {
  ConsistencyAccumulator sums;
  for (std::uint32_t segment = 0; segment < 2; ++segment) {
    for (int i = 0; i < 100; ++i) {
      FeetInstant now;
      now.p_WB = Vec3(0.01 * i, 0.0, segment);
      for (const Leg leg : kLegs) {
        now.contact[leg] = i % 10 < 5;
        now.p_WF[leg] = Vec3(0.01 * i, leg == Leg::kFL ? 0.1 : -0.1, 5.0 * segment);
      }
      sums.Add(now, segment);
    }
  }
  const EstimateConsistency found = sums.Finish();
  EXPECT_EQ(found.footholds, 80u);
  EXPECT_NEAR(found.plane_rms_m, 0.0, 1e-6);
  EXPECT_NEAR(found.path_m, 1.9, 0.11) << "the way between segments is none";
  EXPECT_LT(found.closure_m, 1.0);
}

}  // namespace
}  // namespace scoria::analysis
