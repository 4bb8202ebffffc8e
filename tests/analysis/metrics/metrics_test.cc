// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/metrics.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/rows.h"

namespace scoria::analysis {
namespace {

/// A made-up walk along +x at a constant speed with constant power.
class Walk {
 public:
  explicit Walk(double v_mps) : v_(v_mps) {
    row_.episode->operating = true;
    row_.solve_times = {1e-4, 1e-5};
    row_.true_mass->mass_kg = 10.0;
    row_.command->v_x_mps = 0.5;
    row_.plan->period_s = 0.5;
    row_.episode->segment = 1;
    row_.true_mass->p_WC_z_m = 0.31;
    row_.reference->p_WC_m = {0.0, 0.0, 0.30};
  }
  void Run(MetricsAccumulator& m, double seconds) {
    for (int i = 0; i < std::lround(seconds * 500); ++i) {
      m.AddRow(row_);
      row_.time_s += 0.002;
      row_.truth->p_WB_m[0] += 0.002 * v_;
      row_.truth->v_WB_mps[0] = v_;
      row_.energy->mech_abs_J += 0.002 * 49.05;  // W
      row_.energy->mech_pos_J += 0.002 * 20.0;
      row_.energy->electrical_J += 0.002 * 100.0;
    }
  }
  logs::Row row_ = test::WholeRow();

 private:
  double v_;
};

TEST(Metrics, ConstantWalkGivesItsOwnNumbers) {
  MetricsAccumulator m(9.81);
  Walk walk(0.6);
  walk.Run(m, 20.0);
  const EpisodeMetrics r = m.Finish();
  EXPECT_NEAR(r.distance_m, 12.0, 0.31);  // whole half-second chords
  EXPECT_NEAR(r.cot.value().mech_abs, 49.05 / (10.0 * 9.81 * 0.6), 0.03);
  ASSERT_EQ(r.windows.size(), 3u);  // 3 s to settle, then whole windows of 5 s
  EXPECT_NEAR(r.windows[0].v_mps, 0.6, 1e-3);
  EXPECT_NEAR(r.windows[0].cot_mech_abs, 49.05 / (10.0 * 9.81 * 0.6), 1e-3);
  EXPECT_NEAR(r.tracking.velocity_rmse_mps.value(), 0.1, 1e-6);
  EXPECT_NEAR(r.tracking.height_rmse_m.value(), 0.01, 1e-9);
  EXPECT_NEAR(r.mpc.median_s, 1e-4, 1e-12);
}

// 5 kg are put on half-way: each metre is charged with the mass that was carried over it.
TEST(Metrics, CostOfTransportFollowsTheMassOverTheWay) {
  MetricsAccumulator m(9.81);
  Walk walk(0.5);
  walk.Run(m, 20.0);
  walk.row_.true_mass->mass_kg = 15.0;
  walk.Run(m, 20.0);
  const EpisodeMetrics r = m.Finish();
  EXPECT_NEAR(r.cot.value().mech_abs, 49.05 / (12.5 * 9.81 * 0.5), 0.01);
  ASSERT_FALSE(r.windows.empty());
  EXPECT_NEAR(r.windows.front().cot_mech_abs, 49.05 / (10.0 * 9.81 * 0.5), 1e-3);
  EXPECT_NEAR(r.windows.back().cot_mech_abs, 49.05 / (15.0 * 9.81 * 0.5), 1e-3);
}

TEST(Metrics, PlacementsAndFallsAreNotWalking) {
  MetricsAccumulator m(9.81);
  Walk walk(0.5);
  walk.Run(m, 10.0);
  walk.row_.episode->fallen = true;
  walk.Run(m, 1.0);
  walk.row_.episode->fallen = false;
  walk.row_.episode->segment = 2;
  walk.row_.truth->p_WB_m[0] += 100.0;  // carried away
  walk.Run(m, 10.0);
  const EpisodeMetrics r = m.Finish();
  EXPECT_NEAR(r.distance_m, 10.0, 0.6);
  EXPECT_NEAR(r.walking_s, 20.0, 0.1);
}

// Windows that end in a fall, hold a fallback or go at another speed than the command are no points
// of the cost curve.
TEST(Metrics, OnlySteadyWindowsAreKept) {
  MetricsAccumulator m(9.81);
  Walk walk(0.5);
  walk.Run(m, 8.5);  // settles for 3 s, one window, and falls 0.5 s after it
  walk.row_.episode->fallen = true;
  walk.Run(m, 1.0);
  walk.row_.episode->fallen = false;
  walk.row_.episode->segment = 2;
  walk.Run(m, 5.0);
  walk.row_.supervision->fallen_back[4] = true;  // in the first window of this placement
  walk.Run(m, 1.0);
  walk.row_.supervision->fallen_back[4] = false;
  walk.Run(m, 8.1);  // settles anew, one window
  walk.row_.episode->segment = 3;
  Walk slow(0.2);
  slow.row_ = walk.row_;
  slow.Run(m, 20.0);
  const EpisodeMetrics r = m.Finish();
  ASSERT_EQ(r.windows.size(), 1u);
  EXPECT_NEAR(r.windows[0].v_mps, 0.5, 1e-3);
}

TEST(Metrics, WindowBeforeAFallThatEndsTheEpisodeIsDropped) {
  MetricsAccumulator m(9.81);
  Walk walk(0.5);
  walk.Run(m, 8.5);
  m.AddFall({8.5, "tilt"});
  EXPECT_TRUE(m.Finish().windows.empty());
}

TEST(Metrics, WayBeforeTheFirstFallIsKept) {
  MetricsAccumulator upright(9.81), fell(9.81), ended(9.81);
  Walk walk(0.5), twice(0.5), last(0.5);
  walk.Run(upright, 8.0);
  EXPECT_FALSE(upright.Finish().first_fall_m);
  twice.Run(fell, 8.0);
  for (const std::uint32_t segment : {2u, 3u}) {
    twice.row_.episode->fallen = true;
    twice.Run(fell, 1.0);
    twice.row_.episode->fallen = false;
    twice.row_.episode->segment = segment;
    twice.Run(fell, 4.0);
  }
  EXPECT_NEAR(fell.Finish().first_fall_m.value(), 4.0, 0.01) << "not that before the second one";
  last.Run(ended, 6.0);
  ended.AddFall({6.0, "tilt"});
  EXPECT_NEAR(ended.Finish().first_fall_m.value(), 3.0, 0.01) << "a fall without a row";
}

TEST(Metrics, SpeedRippleWithinAStrideIsNoError) {
  MetricsAccumulator m(9.81);
  Walk walk(0.5);
  for (int i = 0; i < 5000; ++i) {
    walk.row_.time_s = 0.002 * i;
    walk.row_.truth->p_WB_m[0] = 0.5 * walk.row_.time_s;
    walk.row_.truth->v_WB_mps[0] = 0.5 + 0.1 * std::sin(2.0 * M_PI * walk.row_.time_s / 0.25);
    m.AddRow(walk.row_);
  }
  EXPECT_LT(m.Finish().tracking.velocity_rmse_mps.value(), 2e-3);
}

TEST(Metrics, StandingDriftIsTheLargestDistance) {
  MetricsAccumulator m(9.81);
  Walk walk(0.001);
  walk.row_.command->v_x_mps = 0.0;
  walk.Run(m, 13.0);
  EXPECT_NEAR(m.Finish().tracking.drift_m.value(), 0.01, 2e-4);
}

TEST(Metrics, SurviveTheJsonRoundTrip) {
  MetricsAccumulator m(9.81);
  Walk walk(0.4);
  walk.Run(m, 12.0);
  m.AddFall({3.5, "tilt", Vec2(1.0, -2.0)});
  const EpisodeMetrics r = m.Finish();
  const nlohmann::json j = r;
  EXPECT_EQ(nlohmann::json(j.get<EpisodeMetrics>()), j);
}

}  // namespace
}  // namespace scoria::analysis
