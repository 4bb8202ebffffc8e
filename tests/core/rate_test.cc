// SPDX-License-Identifier: BSD-3-Clause
#include "core/rate.h"

#include <limits>

#include <gtest/gtest.h>

namespace scoria::core {
namespace {

TEST(Rate, DividesOrIsRefusedWithItsNeighbours) {
  EXPECT_EQ(StepsBetween(500.0, 0.001), 2);
  EXPECT_EQ(StepsBetween(100.0, 0.0001), 100);
  EXPECT_EQ(StepsBetween(1000.0, 0.001), 1);
  EXPECT_EQ(StepsBetween(1000.0 / 3.0, 0.001), 3);
  EXPECT_EQ(StepsBetween(std::numeric_limits<double>::infinity(), 0.001), 1);
  EXPECT_EQ(StepsBetween(300.0, 0.001), std::nullopt);
  EXPECT_EQ(StepsBetween(2000.0, 0.001), std::nullopt);
  EXPECT_EQ(StepsBetween(0.0, 0.001), std::nullopt);
  EXPECT_EQ(RateProblem(500.0, 0.001), "");
  EXPECT_EQ(RateProblem(300.0, 0.001),
            "300 Hz is no whole number of physics steps of 0.001 s; the nearest rates are 333.3 "
            "and 250 Hz");
  EXPECT_EQ(RateProblem(2000.0, 0.001),
            "2000 Hz is no whole number of physics steps of 0.001 s; the highest rate is 1000 Hz");
  EXPECT_THROW(RateDivider(300.0, 0.001), std::invalid_argument);
}

TEST(RateDivider, ComesInTheFirstStepAndThenEverySoMany) {
  RateDivider clock(250.0, 0.001);
  EXPECT_EQ(clock.every_steps(), 4);
  EXPECT_DOUBLE_EQ(clock.interval_s(), 0.004);
  for (int step = 0; step < 20; ++step) EXPECT_EQ(clock.Tick(), step % 4 == 0) << step;
  EXPECT_TRUE(clock.Tick());
  clock.Reset();
  EXPECT_TRUE(clock.Tick());
}

}  // namespace
}  // namespace scoria::core
