// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/signals/steady.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "analysis/signals/stride_mean.h"

namespace scoria::analysis {
namespace {

TEST(SteadyCommand, SteeringIsNoChangeAndSlowDriftIs) {
  SteadyCommand steady;
  EXPECT_FALSE(steady.IsSettled(10.0)) << "there is no command";
  EXPECT_TRUE(steady.Update(0.0, {0.4, 0.0, 0.0}));
  EXPECT_FALSE(steady.Update(1.0, {0.4, 0.05, 0.5}));
  EXPECT_FALSE(steady.IsSettled(2.9));
  EXPECT_TRUE(steady.IsSettled(3.0));
  for (double v_mps = 0.4; v_mps < 0.5; v_mps += 0.01)
    EXPECT_FALSE(steady.Update(4.0, {v_mps, 0.0, 0.0}));
  EXPECT_TRUE(steady.Update(5.0, {0.55, 0.0, 0.0})) << "0.15 m/s more than in the beginning";
  EXPECT_FALSE(steady.IsSettled(7.9));
  EXPECT_TRUE(steady.Update(9.0, {})) << "standing is another command than walking slowly";
  steady.Restart();
  EXPECT_FALSE(steady.IsSettled(20.0));
  EXPECT_TRUE(steady.Update(20.0, {}));
}

/// Windows of a walk, with the moments at which the samples say that a fallback is on.
std::vector<SteadyWindow> WindowsOf(double v_mps, double command_mps, double seconds, double dt_s,
                                    double fallback_s = -1.0) {
  SteadyWindows windows;
  windows.Restart(0.0);
  std::vector<SteadyWindow> all;
  for (int i = 1; i <= std::lround(seconds / dt_s); ++i) {
    windows.AddWay(v_mps * dt_s);
    const double time_s = dt_s * i;
    const bool on_fallback = std::abs(time_s - fallback_s) < 0.1;
    const auto step = windows.Add({time_s, dt_s, command_mps, on_fallback});
    if (step.ended) all.push_back(*step.ended);
  }
  return all;
}

TEST(SteadyWindows, AreFiveSecondsAfterThreeToSettleAtAnyRate) {
  for (const double dt_s : {0.001, 0.002, 0.01, 0.05}) {
    const auto windows = WindowsOf(0.42, 0.4, 18.5, dt_s);
    ASSERT_EQ(windows.size(), 3u) << dt_s;
    EXPECT_NEAR(windows[0].v_mps, 0.42, 1e-9) << dt_s;
    EXPECT_NEAR(windows[2].command_mps, 0.4, 1e-9) << dt_s;
  }
}

TEST(SteadyWindows, OtherSpeedsStandingAndFallbacksAreNone) {
  EXPECT_TRUE(WindowsOf(0.2, 0.4, 20.0, 0.01).empty());
  EXPECT_TRUE(WindowsOf(0.0, 0.0, 20.0, 0.01).empty());
  EXPECT_EQ(WindowsOf(0.4, 0.4, 13.2, 0.01).size(), 2u);
  EXPECT_EQ(WindowsOf(0.4, 0.4, 13.2, 0.01, 4.0).size(), 1u) << "it settles anew";
}

TEST(StrideMean, RippleOfAStrideVanishes) {
  StrideMean mean;
  for (int i = 0; i < 20000; ++i) {
    const double time_s = 0.002 * i;
    const auto m = mean.Add(time_s, {1.0, std::sin(2.0 * M_PI * time_s / 0.5)}, 0.5);
    EXPECT_EQ(m.has_value(), i >= 250);
    if (m) {
      EXPECT_NEAR((*m - Vec2(1.0, 0.0)).norm(), 0.0, 1e-9);
    }
  }
  mean.Reset();
  EXPECT_FALSE(mean.Add(41.0, {1.0, 1.0}, 0.5).has_value());
}

}  // namespace
}  // namespace scoria::analysis
