// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/low_pass.h"

#include <gtest/gtest.h>

#include "core/math/types.h"

namespace scoria::core {
namespace {

// The exact answer to a step, in steps of any length.
TEST(LowPass, AnswersAStepAlikeInStepsOfAnyLength) {
  for (const int steps : {1, 10, 1000}) {
    double y = 0.0;
    for (int i = 0; i < steps; ++i) LowPass(y, 1.0, 0.5, 0.5 / steps);
    EXPECT_NEAR(y, 1.0 - std::exp(-1.0), 1e-12) << steps;
  }
}

TEST(LowPass, HasItsCutoffWhereTheTimeConstantSays) {
  EXPECT_DOUBLE_EQ(TimeConstant_s(1.0 / (2.0 * std::numbers::pi)), 1.0);
}

TEST(LowPass, FollowsAtOnceWithoutATimeConstantAndNotAtAllWithAnInfiniteOne) {
  Vec3 y = Vec3::Zero();
  LowPass(y, Vec3(1.0, 2.0, 3.0), 0.0, 0.01);
  EXPECT_EQ(y, Vec3(1.0, 2.0, 3.0));
  LowPass(y, Vec3(0.0, 0.0, 0.0), std::numeric_limits<double>::infinity(), 0.01);
  EXPECT_EQ(y, Vec3(1.0, 2.0, 3.0));
}

}  // namespace
}  // namespace scoria::core
