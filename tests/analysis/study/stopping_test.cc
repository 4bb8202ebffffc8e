// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/stopping.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/study/results.h"
#include "tests/analysis/statistics/made_up_falls.h"

namespace scoria::analysis {
namespace {

EpisodeRecord Walked(const std::string& arm, std::uint64_t seed, long falls, double height_m) {
  EpisodeRecord e;
  e.arm = arm;
  e.seed = seed;
  e.has_metrics = true;
  e.metrics.outcome.emplace();
  e.metrics.outcome->falls = static_cast<int>(falls);
  e.metrics.distance_m = 50.0;
  e.metrics.tracking.samples_s = 10.0;
  e.metrics.tracking.height_rmse_m = height_m;
  return e;
}

/// A campaign of two arms that may stop after each of its terrains.
StopRecord Walk(const std::vector<PairedCounts>& terrains) {
  SequentialStop stop({"falls", 0.05}, {"a", "b"});
  for (std::size_t i = 0; i < terrains.size() && !stop.decided(); ++i)
    stop.AddSeed(i, std::vector{Walked("a", i, terrains[i].events_a, 0.01),
                                Walked("b", i, terrains[i].events_b, 0.01)});
  return stop.record();
}

int CountStops(const test::FallModel& model, std::uint64_t first_seed) {
  int stops = 0;
  for (std::uint64_t i = 0; i < 1000; ++i)
    stops += Walk(test::MakeFalls(model, 60, first_seed + i)).last_seed ? 1 : 0;
  return stops;
}

// A against A at 5 %, looking after every seed: Poisson falls, over terrains that are hard and
// easy for both, and for each arm by itself (negative binomial).
TEST(SequentialStop, SeldomStopsWhereArmsAreEqual) {
  for (const double falls : {0.3, 2.0}) {
    EXPECT_LE(CountStops({.falls = falls}, 1), 66);
    EXPECT_LE(CountStops({.falls = falls, .terrain_shape = 1}, 10'000), 66);
    EXPECT_LE(CountStops({.falls = falls, .arm_shape = 1}, 20'000), 66);
  }
}

TEST(SequentialStop, StopsEarlyWhereOneArmFallsMore) {
  EXPECT_GT(CountStops({.falls = 1.0, .ratio = 4.0, .arm_shape = 1}, 1), 900);
  const StopRecord record = Walk(std::vector<PairedCounts>(20, {2, 0, 50.0, 50.0}));
  EXPECT_EQ(record.last_seed, 6u) << "seven seeds";
  EXPECT_EQ(record.seeds, 7);
  EXPECT_EQ(DescribeStop(record).find("Stopped by itself after seed 6: falls of b against a p = "),
            0u)
      << DescribeStop(record);
}

TEST(SequentialStop, GoesOnUntilEveryComparisonIsDecided) {
  SequentialStop stop({"height_rmse_m", 0.05}, {"a", "same", "worse"});
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const double noise = seed % 2 == 0 ? 0.001 : -0.001;
    stop.AddSeed(seed, std::vector{Walked("a", seed, 0, 0.02), Walked("worse", seed, 0, 0.03),
                                   Walked("same", seed, 0, 0.02 + noise)});
  }
  EXPECT_FALSE(stop.decided());
  ASSERT_EQ(stop.record().comparisons.size(), 2u);
  EXPECT_GT(stop.record().comparisons[0].p_any_time, 0.2);
  EXPECT_LT(stop.record().comparisons[1].p_any_time, 1e-4);
  EXPECT_EQ(DescribeStop(stop.record()).find("Not decided in 30 seeds: height_rmse_m of same "), 0u)
      << DescribeStop(stop.record());
}

TEST(SequentialStop, ASeedIsOneDatumHoweverManyPointsItHas) {
  SequentialStop stop({"height_rmse_m", 0.05}, {"a", "b"});
  std::vector<EpisodeRecord> episodes;
  for (int point = 0; point < 50; ++point) {
    for (const char* arm : {"a", "b"}) {
      episodes.push_back(Walked(arm, 1, 0, *arm == 'a' ? 0.02 : 0.03));
      episodes.back().point = {std::to_string(point)};
    }
  }
  episodes.back().has_metrics = false;  // that crashed
  stop.AddSeed(1, episodes);
  EXPECT_FALSE(stop.decided());
}

TEST(StopRecord, IsReadAsItIsWritten) {
  StopRecord record = Walk(std::vector<PairedCounts>(20, {2, 0, 50.0, 50.0}));
  EXPECT_EQ(StopFromJson(ToJson(record)), record);
  record.last_seed.reset();
  EXPECT_EQ(StopFromJson(ToJson(record)), record);
}

}  // namespace
}  // namespace scoria::analysis
