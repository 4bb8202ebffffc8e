// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/regression_evidence.h"

#include <algorithm>

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
int SeedsToAlarm(std::uint64_t experiment, double worse_m, double fall_share = 0.3,
                 bool with_twin = false) {
  Walks walks(experiment);
  const CampaignResults before = walks.Draw(1, 0.0), now = walks.Draw(2, worse_m, fall_share);
  RegressionEvidence evidence(before, with_twin ? walks.Draw(3, 0.0) : CampaignResults());
  for (int i = 0; i < kSeeds; ++i) {
    evidence.AddSeed(static_cast<std::uint64_t>(i), before, now);
    if (evidence.evidence().Rejects(0.01)) return i + 1;
  }
  return kSeeds + 1;
}

TEST(RegressionEvidence, HardlyAlarmsWhereNothingBecameWorse) {
  constexpr int kExperiments = 500;
  for (const bool with_twin : {false, true}) {
    int alarms = 0, alarms_of_better = 0;
    for (std::uint64_t i = 0; i < kExperiments; ++i) {
      if (SeedsToAlarm(i, 0.0, 0.3, with_twin) <= kSeeds) ++alarms;
      if (SeedsToAlarm(i, -0.003, 0.3, with_twin) <= kSeeds) ++alarms_of_better;
    }
    EXPECT_LE(alarms, 11) << "1 % of 500, and twice the deviation of a binomial count";
    EXPECT_EQ(alarms_of_better, 0);
  }
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

// A seed says most of how a walk goes: without a twin the spread of the seeds hides the effect.
TEST(RegressionEvidence, ATwinTellsHowMuchWalksDifferWhereNothingChanged) {
  constexpr double kWorse_m = 2.5 * kWalk_m;
  std::vector<int> with, without;
  for (std::uint64_t i = 0; i < 51; ++i) {
    with.push_back(SeedsToAlarm(5000 + i, kWorse_m, 0.3, true));
    without.push_back(SeedsToAlarm(5000 + i, kWorse_m, 0.3, false));
  }
  std::ranges::sort(with);
  std::ranges::sort(without);
  EXPECT_LE(2 * with[25], without[25]) << with[25] << " and " << without[25] << " seeds";
}

// Twins that are the baseline, bit for bit or but for one walk, tell no scale.
TEST(RegressionEvidence, ATwinThatHardlyDiffersIsPassedOver) {
  for (const bool one_differs : {false, true}) {
    Walks walks(17);
    const CampaignResults before = walks.Draw(1, 0.0), now = walks.Draw(2, 0.0);
    CampaignResults twin = before;
    for (std::size_t i = 0; i < twin.episodes.size(); ++i) {
      double& height_m = *twin.episodes[i].metrics.tracking.height_rmse_m;
      if (one_differs) height_m += i == 5 ? 1e-3 : 1e-9 * static_cast<double>(i + 1);
    }
    RegressionEvidence evidence(before, twin);
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) evidence.AddSeed(seed, before, now);
    EXPECT_FALSE(evidence.evidence().Rejects(0.01));
  }
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

// A second ground, on which nothing changes, hardly hides what became worse on the first.
TEST(RegressionEvidence, EachPointIsLookedAtByItself) {
  const auto with_second_ground = [](CampaignResults first, const CampaignResults& second) {
    for (EpisodeRecord& e : first.episodes) e.point = {"first"};
    for (EpisodeRecord e : second.episodes) {
      e.point = {"second"};
      first.episodes.push_back(std::move(e));
    }
    return first;
  };
  int alarms = 0;
  for (std::uint64_t i = 0; i < 50; ++i) {
    Walks first(3000 + i), second(4000 + i);
    const CampaignResults before = with_second_ground(first.Draw(1, 0.0), second.Draw(1, 0.0)),
                          now = with_second_ground(first.Draw(2, 0.04), second.Draw(2, 0.0));
    RegressionEvidence evidence(before);
    evidence.AddSeed(0, before, now);
    evidence.AddSeed(1, before, now);
    if (!evidence.evidence().Rejects(0.01)) continue;
    ++alarms;
    const auto strongest = evidence.Lines().front();
    EXPECT_EQ(strongest.metric.key, "height_rmse_m");
    EXPECT_EQ(strongest.place, (RegressionEvidence::Place{"a", {"first"}}));
  }
  EXPECT_EQ(alarms, 50) << "ten times the spread of terrains";
}

// The same number of falls in half the way is worse, and the reverse is no evidence.
TEST(RegressionEvidence, FallsCountOverTheWayWalked) {
  for (const bool shorter : {true, false}) {
    Walks walks(9);
    CampaignResults before = walks.Draw(1, 0.0, 0.0), now = walks.Draw(1, 0.0, 0.0);
    for (CampaignResults* r : {&before, &now}) {
      for (EpisodeRecord& e : r->episodes) e.metrics.outcome->falls = 2;
    }
    for (EpisodeRecord& e : (shorter ? now : before).episodes) e.metrics.distance_m = 5.0;
    RegressionEvidence evidence(before);
    for (int seed = 0; seed < kSeeds; ++seed)
      evidence.AddSeed(static_cast<std::uint64_t>(seed), before, now);
    EXPECT_EQ(evidence.evidence().Rejects(0.01), shorter);
  }
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
