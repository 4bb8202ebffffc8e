// SPDX-License-Identifier: BSD-3-Clause
#include "core/event_clock.h"

#include <gtest/gtest.h>

namespace scoria::core {
namespace {

constexpr double kStep_s = 0.001;

/// Steps in which an event of 0.5 s at 1 s of walking runs, if the robot lies between these times.
int StepsOfEvent(double falls_s, double walks_on_s) {
  EventTimer timer;
  EventClock now;
  int running = 0, begun = 0;
  for (int k = 0; k < 20000; ++k) {
    now.time_s = k * kStep_s;
    if (now.time_s < falls_s || now.time_s >= walks_on_s) now.walking_s += kStep_s;
    begun += timer.BeginAfter(1.0, now) ? 1 : 0;
    running += timer.Runs(0.5, now) ? 1 : 0;
  }
  EXPECT_EQ(begun, 1);
  return running;
}

TEST(EventTimer, LastsItsDurationInSimulatedTime) {
  EXPECT_EQ(StepsOfEvent(100.0, 100.0), 500) << "a walk without a break";
  EXPECT_EQ(StepsOfEvent(1.2, 9.0), 500) << "the robot falls while it runs";
}

TEST(EventTimer, AFallBeforeItPutsItOff) {
  EventTimer timer;
  EventClock now{0.5, 0.0, 0.5};
  EXPECT_FALSE(timer.BeginAfter(1.0, now));
  now.time_s = 60.0;  // the robot lay for a minute
  EXPECT_FALSE(timer.BeginAfter(1.0, now));
  now = {1.25, 0.0, 60.75};
  EXPECT_TRUE(timer.BeginAfter(1.0, now));
  EXPECT_DOUBLE_EQ(*timer.begun_s(), 60.5);
}

TEST(EventTimer, BeginsBeyondADistance) {
  EventTimer timer;
  EXPECT_FALSE(timer.BeginBeyond(3.0, {9.0, 3.0, 9.0}));
  EXPECT_TRUE(timer.BeginBeyond(3.0, {9.5, 3.1, 9.5}));
  EXPECT_FALSE(timer.BeginBeyond(3.0, {9.6, 3.2, 9.6})) << "once";
  EXPECT_DOUBLE_EQ(*timer.begun_s(), 9.5);
}

}  // namespace
}  // namespace scoria::core
