// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/clock.h"

#include <gtest/gtest.h>

#include "tests/logs/mapping/times.h"

namespace scoria::logs {
namespace {

using test::kMs;

ClockEvidence EvidenceOf(ClockChoice clock, double irregularity, std::uint64_t num_back = 0) {
  return {clock, 1000, num_back, 0.002, irregularity};
}

TEST(Clock, RegularTimesHaveNoSpread) {
  ClockStatistics clock;
  for (int i = 0; i < 100'000; ++i) clock.Add(i * 2 * kMs);
  EXPECT_EQ(clock.MedianStep(), 2 * kMs);
  EXPECT_EQ(clock.Irregularity(), 0.0);
  EXPECT_EQ(clock.num_back(), 0u);
  EXPECT_EQ(clock.largest_step_back_ns(), 0);
}

TEST(Clock, BurstsAndStepsBackShow) {
  ClockStatistics clock;
  for (int i = 0; i < 1000; ++i) clock.Add((i - i % 10) * 2 * kMs);  // ten at a time
  EXPECT_EQ(clock.MedianStep(), 0);
  EXPECT_NEAR(static_cast<double>(clock.TypicalStep().value()), 2.0 * kMs, 0.1 * kMs);
  EXPECT_FALSE(clock.Irregularity());
  clock.Add(1990 * kMs);
  clock.Add(1980 * kMs);
  EXPECT_EQ(clock.num_back(), 1u);
  EXPECT_EQ(clock.largest_step_back_ns(), 10 * kMs);
}

TEST(Clock, TheMostRegularIsChosen) {
  const std::vector<ClockEvidence> evidence = {EvidenceOf(ClockChoice::kHeader, 0.5),
                                               EvidenceOf(ClockChoice::kCounter, 0.1),
                                               EvidenceOf(ClockChoice::kReceive, 2.0)};
  EXPECT_EQ(ChooseClock(ClockChoice::kAuto, evidence), ClockChoice::kCounter);
  EXPECT_EQ(ChooseClock(ClockChoice::kReceive, evidence), ClockChoice::kReceive);
  EXPECT_EQ(ChooseClock(ClockChoice::kRow, evidence), std::nullopt);
  EXPECT_EQ(ChooseClock(ClockChoice::kAuto, {}), std::nullopt);
}

TEST(Clock, OfEqualsTheHeaderIsChosenAndNoneThatGoesBack) {
  EXPECT_EQ(ChooseClock(ClockChoice::kAuto, {EvidenceOf(ClockChoice::kReceive, 0.1),
                                             EvidenceOf(ClockChoice::kHeader, 0.1)}),
            ClockChoice::kHeader);
  EXPECT_EQ(ChooseClock(ClockChoice::kAuto, {EvidenceOf(ClockChoice::kReceive, 0.5),
                                             EvidenceOf(ClockChoice::kHeader, 0.1, 20)}),
            ClockChoice::kReceive);
}

TEST(Clock, EvidenceIsTold) {
  EXPECT_EQ(DescribeClocks(ClockChoice::kHeader, {EvidenceOf(ClockChoice::kHeader, 0.08),
                                                  EvidenceOf(ClockChoice::kReceive, 3.1, 2)}),
            "header (steps of 2 ms, irregularity 0.08; receive: steps of 2 ms, irregularity 3.1, "
            "goes back 2 times)");
}

}  // namespace
}  // namespace scoria::logs
