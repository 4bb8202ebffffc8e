// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/regression_evidence.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/rng.h"

namespace scoria::analysis {
namespace {

constexpr int kSeeds = 40;
constexpr double kTerrain_m = 0.004, kWalk_m = 0.002;  // spread between terrains, and of one walk

/// Heights and falls of walks on `kSeeds` terrains, drawn for each walk anew.
class Walks {
 public:
  explicit Walks(std::uint64_t experiment) : experiment_(experiment) {
    core::Rng terrain(experiment, 0, core::Stream::kOperator);
    for (int i = 0; i < kSeeds; ++i) {
      height_m_.push_back(0.02 + kTerrain_m * terrain.NextNormal());
      hard_.push_back(terrain.NextUniform(0.0, 1.0) < 0.2);
    }
  }

  /// @param worse_m  added to the error of the height. @param fall_share  of hard terrains.
  CampaignResults Draw(std::uint32_t build, double worse_m, double fall_share = 0.3) {
    core::Rng rng(experiment_, build, core::Stream::kOperator);
    CampaignResults results;
    results.arms = {"a"};
    for (int i = 0; i < kSeeds; ++i) {
      EpisodeRecord& e = results.episodes.emplace_back();
      e.arm = "a";
      e.seed = static_cast<std::uint64_t>(i);
      e.has_metrics = true;
      e.metrics.tracking.samples_s = 10.0;
      e.metrics.tracking.height_rmse_m =
          height_m_[static_cast<std::size_t>(i)] + worse_m + kWalk_m * rng.NextNormal();
      e.metrics.distance_m = 10.0;
      e.metrics.outcome = EpisodeOutcome{};
      const double share = hard_[static_cast<std::size_t>(i)] ? fall_share : 0.0;
      e.metrics.outcome->falls = rng.NextUniform(0.0, 1.0) < share ? 2 : 0;
    }
    return results;
  }

 private:
  std::uint64_t experiment_;
  std::vector<double> height_m_;
  std::vector<bool> hard_;
};

/// How many seeds it takes to an alarm at 1 %; more than there are for none.
int SeedsToAlarm(std::uint64_t experiment, double worse_m, double fall_share = 0.3) {
  Walks walks(experiment);
  const CampaignResults before = walks.Draw(1, 0.0), now = walks.Draw(2, worse_m, fall_share);
  RegressionEvidence evidence(before);
  for (int i = 0; i < kSeeds; ++i) {
    evidence.AddSeed(static_cast<std::uint64_t>(i), before, now);
    if (evidence.evidence().Rejects(0.01)) return i + 1;
  }
  return kSeeds + 1;
}

TEST(RegressionEvidence, HardlyAlarmsWhereNothingBecameWorse) {
  constexpr int kExperiments = 500;
  int alarms = 0, alarms_of_better = 0;
  for (int i = 0; i < kExperiments; ++i) {
    if (SeedsToAlarm(static_cast<std::uint64_t>(i), 0.0) <= kSeeds) ++alarms;
    if (SeedsToAlarm(static_cast<std::uint64_t>(i), -0.003) <= kSeeds) ++alarms_of_better;
  }
  EXPECT_LE(alarms, 11) << "1 % of 500, and twice the deviation of a binomial count";
  EXPECT_EQ(alarms_of_better, 0);
}

TEST(RegressionEvidence, NeedsFewSeedsForALargeEffectAndMoreForASmallOne) {
  int large = 0, small = 0;
  constexpr int kExperiments = 50;
  for (int i = 0; i < kExperiments; ++i) {
    const auto experiment = static_cast<std::uint64_t>(1000 + i);
    if (SeedsToAlarm(experiment, 0.05) == 1) ++large;
    if (SeedsToAlarm(experiment, 0.004) <= kSeeds) ++small;
  }
  EXPECT_EQ(large, kExperiments) << "ten times the spread shows at once";
  EXPECT_GE(small, 45) << "the spread of the terrains";
}

TEST(RegressionEvidence, SeesFallsWhereMetricsStay) {
  int alarms = 0;
  constexpr int kExperiments = 50;
  for (int i = 0; i < kExperiments; ++i) {
    Walks walks(static_cast<std::uint64_t>(2000 + i));
    const CampaignResults before = walks.Draw(1, 0.0, 0.0);
    CampaignResults now = walks.Draw(2, 0.0, 0.0);
    for (EpisodeRecord& e : now.episodes) e.metrics.outcome->falls = 1;
    RegressionEvidence evidence(before);
    for (int seed = 0; seed < kSeeds; ++seed)
      evidence.AddSeed(static_cast<std::uint64_t>(seed), before, now);
    if (evidence.evidence().Rejects(0.01)) ++alarms;
  }
  EXPECT_EQ(alarms, kExperiments);
}

TEST(RegressionEvidence, LinesHaveTheMeansStrongestFirst) {
  Walks walks(7);
  const CampaignResults before = walks.Draw(1, 0.0), now = walks.Draw(2, 0.02);
  RegressionEvidence evidence(before);
  for (int i = 0; i < kSeeds; ++i) evidence.AddSeed(static_cast<std::uint64_t>(i), before, now);
  const auto lines = evidence.Lines();
  ASSERT_GE(lines.size(), 2u);
  EXPECT_EQ(lines[0].metric.key, "height_rmse_m");
  EXPECT_EQ(lines[0].pairs, kSeeds);
  EXPECT_NEAR(lines[0].mean - lines[0].baseline_mean, 0.02, 0.002);
  for (const auto& line : lines) {
    EXPECT_NE(line.metric.family, MetricFamily::kTiming);
    EXPECT_NE(line.metric.better, Better::kNeither);
  }
}

}  // namespace
}  // namespace scoria::analysis
