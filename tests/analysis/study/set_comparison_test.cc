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

EpisodeMetrics Walk(double way_m, double time_s) {
  EpisodeMetrics m;
  m.distance_m = way_m;
  m.walking_s = time_s;
  return m;
}

TEST(SetComparison, FindsWhatDiffersAndSaysSo) {
  const std::vector<EpisodeMetrics> a = {Walk(10.0, 5.0), Walk(10.1, 5.3), Walk(9.9, 4.9)},
                                    b = {Walk(12.0, 5.1), Walk(12.1, 5.2), Walk(11.8, 4.8)};
  const SetComparison found = CompareSets(a, b, TwoMetrics());
  ASSERT_EQ(found.metrics.size(), 2u);
  EXPECT_TRUE(IsDifferent(found.metrics[0], 0.05));
  EXPECT_TRUE(DescribeDifference(found.metrics[0], 0.05)
                  .starts_with("way is larger in the second: 11.97, not 10.00 ("));
  EXPECT_FALSE(IsDifferent(found.metrics[1], 0.05));
  EXPECT_TRUE(DescribeDifference(found.metrics[1], 0.05)
                  .starts_with("time: no evidence of a difference, 5.07 and 5.03 (p = "));
}

TEST(SetComparison, AdjustsForTheNumberOfMetrics) {
  const std::vector<EpisodeMetrics> a = {Walk(1.0, 1.0), Walk(2.0, 2.0), Walk(3.0, 3.0)},
                                    b = {Walk(4.0, 4.0), Walk(5.0, 5.0), Walk(6.0, 6.0)};
  const SetComparison found = CompareSets(a, b, TwoMetrics());
  EXPECT_NEAR(*found.metrics[0].p_adjusted, 2.0 * *found.metrics[0].samples.p, 1e-12);
}

TEST(SetComparison, TellsWhyThereIsNoTest) {
  const std::vector<EpisodeMetrics> a = {Walk(1.0, 1.0)}, b = {Walk(2.0, 1.0)};
  const SetComparison found = CompareSets(a, b, TwoMetrics());
  EXPECT_EQ(DescribeDifference(found.metrics[0], 0.05),
            "way: 1.00 and 2.00; with a walk on each side, how much walks vary is not known");
  const std::vector<EpisodeMetrics> same = {Walk(2.0, 1.0), Walk(2.0, 1.0)};
  EXPECT_EQ(DescribeDifference(CompareSets(a, same, TwoMetrics()).metrics[0], 0.05),
            "way: 1.00 and 2.00; it does not vary within the sets, so that there is nothing to "
            "test with");
}

TEST(SetComparison, LeavesOutWhatComesFromOtherSources) {
  Metrics metrics = TwoMetrics();
  metrics[0].info.needs = Groups({logs::RowGroup::kTruth});
  EpisodeMetrics by_legs = Walk(1.0, 1.0);
  by_legs.substitutes[logs::RowGroup::kTruth] = "the legs";
  const SetComparison found =
      CompareSets(std::vector{by_legs}, std::vector{Walk(1.0, 1.0), Walk(2.0, 2.0)}, metrics);
  ASSERT_EQ(found.other_sources.size(), 1u);
  EXPECT_EQ(found.other_sources[0].key, "way");
  EXPECT_EQ(found.metrics.size(), 1u);
}

}  // namespace
}  // namespace scoria::analysis
