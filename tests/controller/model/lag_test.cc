// SPDX-License-Identifier: BSD-3-Clause
#include "controller/model/lag.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/motion.h"

namespace scoria::controller {
namespace {

using Scalar = LowPassChain<1>::Vector;

using test::kStep_s;

Scalar Of(double x) { return Scalar::Constant(x); }

TEST(CalcLag, RoundsTheDelayAndIsOpenWithoutALoop) {
  const Lag lag = CalcLag(0.0024, 0.0, 60.0, kStep_s);
  EXPECT_EQ(lag.steps, 2u);
  EXPECT_EQ(lag.loop_share, 1.0);
  EXPECT_DOUBLE_EQ(lag.share, 1.0 - std::exp(-2.0 * std::numbers::pi * 0.06));
}

TEST(LowPassChain, StepsAsACriticallyDampedLoop) {
  constexpr double kLoop_Hz = 5.0, kOmega_radps = 2.0 * std::numbers::pi * kLoop_Hz;
  Lag lag = CalcLag(0.0, kLoop_Hz, 60.0, kStep_s);
  lag.share = 1.0;
  LowPassChain<1> chain;
  for (int i = 1; i <= 300; ++i) {
    const double x = kOmega_radps * kStep_s * i;
    const double expected = 1.0 - (1.0 + x) * std::exp(-x);
    // Either pole leads by no more than one step.
    EXPECT_NEAR(chain.Update(Of(1.0), Of(0.0), lag)[0], expected, kOmega_radps * kStep_s);
  }
}

TEST(LowPassChain, WhatIsMadeOfSpeedsSkipsTheLoop) {
  const Lag lag = CalcLag(0.0, 5.0, 60.0, kStep_s);
  LowPassChain<1> chain;
  for (int i = 1; i <= 50; ++i) {
    const double expected = 1.0 - std::pow(1.0 - lag.share, i);
    EXPECT_NEAR(chain.Update(Of(0.0), Of(1.0), lag)[0], expected, 1e-12);
  }
}

TEST(LowPassChain, StaysWhereItIsSettled) {
  const Lag lag = CalcLag(0.0, 125.0, 60.0, kStep_s);
  LowPassChain<1> chain;
  chain.Settle(Of(0.3));
  EXPECT_EQ(chain.Update(Of(0.3), Of(0.0), lag), Of(0.3));
  // An open lag lets the input through at once.
  EXPECT_EQ(LowPassChain<1>().Update(Of(0.3), Of(0.4), Lag{}), Of(0.7));
}

}  // namespace
}  // namespace scoria::controller
