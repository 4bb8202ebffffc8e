// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/set_comparison.h"

#include <gtest/gtest.h>

#include "analysis/metrics/episode_metrics.h"

namespace scoria::analysis {
namespace {

Metric Of(std::string_view key, std::optional<Measured> (*find)(const EpisodeMetrics&)) {
  Metric metric{{.key = key, .title = key}, find, nullptr};
  return metric;
}

/// Metrics that tests can set: of the way, and of the time of walking.
Metrics TwoMetrics() {
  return {Of("way", [](const EpisodeMetrics& m) { return std::optional(Measured{m.distance_m}); }),
          Of("time", [](const EpisodeMetrics& m) { return std::optional(Measured{m.walking_s}); })};
}

ComparedWalk Walk(double way_m, double time_s) {
  ComparedWalk walk;
  walk.metrics.distance_m = way_m;
  walk.metrics.walking_s = time_s;
  return walk;
}

/// Slips spread evenly around 10 mm, and a tail of so many times 1 mm.
ComparedWalk SlippingWalk(double shift_mm, double tail_mm) {
  ComparedWalk walk = Walk(1.0, 1.0);
  Distribution& slips = walk.signals[Signal::kSlip];
  for (int i = 0; i < 1000; ++i) {
    const double share = 1e-3 * i;
    slips.Add(1e-3 * (10.0 + shift_mm + share + (share > 0.9 ? tail_mm : 0.0)));
  }
  return walk;
}

TEST(SetComparison, FindsWhatDiffersAndSaysSo) {
  const std::vector<ComparedWalk> a = {Walk(10.0, 5.0), Walk(10.1, 5.3), Walk(9.9, 4.9)},
                                  b = {Walk(12.0, 5.1), Walk(12.1, 5.2), Walk(11.8, 4.8)};
  const SetComparison found = CompareSets(a, b, TwoMetrics());
  ASSERT_EQ(found.metrics.size(), 2u);
  EXPECT_TRUE(IsDifferent(found.metrics[0].p_adjusted, 0.05));
  EXPECT_TRUE(DescribeDifference(found.metrics[0], 0.05)
                  .starts_with("way is larger in the second: 11.97, not 10.00 ("));
  EXPECT_FALSE(IsDifferent(found.metrics[1].p_adjusted, 0.05));
  EXPECT_TRUE(DescribeDifference(found.metrics[1], 0.05)
                  .starts_with("time: no evidence of a difference, 5.07 and 5.03 (p = "));
}

TEST(SetComparison, AdjustsForTheNumberOfMetrics) {
  const std::vector<ComparedWalk> a = {Walk(1.0, 1.0), Walk(2.0, 2.0), Walk(3.0, 3.0)},
                                  b = {Walk(4.0, 4.0), Walk(5.0, 5.0), Walk(6.0, 6.0)};
  const SetComparison found = CompareSets(a, b, TwoMetrics());
  EXPECT_NEAR(*found.metrics[0].p_adjusted, 2.0 * *found.metrics[0].samples.p, 1e-12);
}

TEST(SetComparison, TellsWhyThereIsNoTest) {
  const std::vector<ComparedWalk> a = {Walk(1.0, 1.0)}, b = {Walk(2.0, 1.0)};
  const SetComparison found = CompareSets(a, b, TwoMetrics());
  EXPECT_EQ(DescribeDifference(found.metrics[0], 0.05),
            "way: 1.00 and 2.00; with a walk on each side, how much walks vary is not known");
  const std::vector<ComparedWalk> same = {Walk(2.0, 1.0), Walk(2.0, 1.0)};
  EXPECT_EQ(DescribeDifference(CompareSets(a, same, TwoMetrics()).metrics[0], 0.05),
            "way: 1.00 and 2.00; it does not vary within the sets, so that there is nothing to "
            "test with");
}

TEST(SetComparison, LeavesOutWhatComesFromOtherSources) {
  Metrics metrics = TwoMetrics();
  metrics[0].info.needs = Groups({logs::RowGroup::kTruth});
  ComparedWalk by_legs = Walk(1.0, 1.0);
  by_legs.metrics.substitutes[logs::RowGroup::kTruth] = "the legs";
  const SetComparison found =
      CompareSets(std::vector{by_legs}, std::vector{Walk(1.0, 1.0), Walk(2.0, 2.0)}, metrics);
  ASSERT_EQ(found.other_sources.size(), 1u);
  EXPECT_EQ(found.other_sources[0].key, "way");
  EXPECT_EQ(found.metrics.size(), 1u);
}

TEST(SetComparison, WhatWasAskedOfAWalkIsNoDifference) {
  const Metrics metrics = {
      Of("yaw_rate_radps",
         [](const EpisodeMetrics& m) { return std::optional(Measured{m.distance_m}); }),
      Of("command_yaw_radps",
         [](const EpisodeMetrics& m) { return std::optional(Measured{m.walking_s}); })};
  const std::vector<ComparedWalk> a = {Walk(1.0, 0.9), Walk(1.1, 1.02)},
                                  b = {Walk(5.0, 4.9), Walk(5.3, 5.18)};
  const SetComparison found = CompareSets(a, b, metrics);
  ASSERT_EQ(found.metrics.size(), 1u) << "no command is an outcome";
  EXPECT_EQ(found.metrics[0].metric.title, "yaw rate less its command");
  EXPECT_NEAR(found.metrics[0].samples.mean_a, 0.09, 1e-9);
  EXPECT_NEAR(found.metrics[0].samples.mean_b, 0.11, 1e-9);
}

TEST(SetComparison, PhasesAreOnACircle) {
  Metrics metrics = {Of(
      "phase_hr", [](const EpisodeMetrics& m) { return std::optional(Measured{m.distance_m}); })};
  const std::vector<ComparedWalk> a = {Walk(0.99, 0.0), Walk(0.01, 0.0), Walk(0.0, 0.0)},
                                  b = {Walk(0.02, 0.0), Walk(0.98, 0.0), Walk(0.03, 0.0)};
  const TwoSamples found = CompareSets(a, b, metrics).metrics.at(0).samples;
  EXPECT_NEAR(found.mean_a, 0.0, 1e-12);
  EXPECT_NEAR(found.mean_b, 0.01, 1e-12);
}

TEST(SetComparison, FindsATailThatMeansHide) {
  const std::vector<ComparedWalk> a = {SlippingWalk(0.0, 1.0), SlippingWalk(0.3, 1.2),
                                       SlippingWalk(-0.2, 0.9), SlippingWalk(0.1, 1.1)},
                                  b = {SlippingWalk(0.1, 6.0), SlippingWalk(-0.1, 6.3),
                                       SlippingWalk(0.2, 5.8), SlippingWalk(0.0, 6.1)};
  const SetComparison found = CompareSets(a, b, TwoMetrics());
  ASSERT_EQ(found.signals.size(), 1u);
  const SignalDifference& slip = found.signals[0];
  EXPECT_TRUE(IsDifferent(slip.p_adjusted, 0.05));
  EXPECT_EQ(slip.Strongest()->share, 0.95);
  EXPECT_GT(*slip.quantiles[2].samples.p, 0.1) << "the medians are those of one ground";
  EXPECT_TRUE(DescribeDifference(slip, 0.05)
                  .starts_with("95 % quantile of slip is larger in the second: 17.1 mm, not 12.1"))
      << DescribeDifference(slip, 0.05);
}

TEST(SetComparison, AWalkIsOneValueOfADistribution) {
  const std::vector<ComparedWalk> a = {SlippingWalk(0.0, 1.0), SlippingWalk(2.0, 1.0),
                                       SlippingWalk(-2.0, 1.0)},
                                  b = {SlippingWalk(1.0, 1.0), SlippingWalk(2.5, 1.0),
                                       SlippingWalk(-1.5, 1.0)};
  const SetComparison found = CompareSets(a, b, TwoMetrics());
  ASSERT_EQ(found.signals.size(), 1u) << "3000 slips a set would call it different";
  EXPECT_FALSE(IsDifferent(found.signals[0].p_adjusted, 0.05));
  EXPECT_TRUE(DescribeDifference(found.signals[0], 0.05)
                  .starts_with("distribution of slip: no evidence of a difference; furthest apart "
                               "is the "));
}

}  // namespace
}  // namespace scoria::analysis
