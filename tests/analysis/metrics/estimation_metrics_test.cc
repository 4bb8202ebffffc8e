// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/estimation_metrics.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/metrics.h"
#include "tests/support/allocation_guard.h"

namespace scoria::analysis {
namespace {

constexpr double kRow_s = 0.002;
constexpr double kPerMetre = M_PI / 180.0;  // rad, one degree

/// A walk along +x at 0.5 m/s with a perfect estimate, to be spoiled row by row.
class Walk {
 public:
  using Spoil = std::function<void(logs::LogRow&, double x_m)>;
  Walk() {
    row_.operating = true;
    row_.segment = 1;
    row_.p_WB_m = {3.0, -2.0, 0.3};
    row_.v_WB_mps = {0.5, 0.0, 0.0};
    start_x_m_ = row_.p_WB_m[0];
  }
  void Run(EstimationAccumulator& e, double metres, const Spoil& spoil) {
    for (long i = std::lround(metres / 0.001); i > 0; --i) {
      logs::LogRow row = row_;
      row.est_p_WB_m = row.p_WB_m;
      row.est_v_WB_mps = row.v_WB_mps;
      row.est_rpy_rad = row.rpy_rad;
      spoil(row, row_.p_WB_m[0] - start_x_m_);
      e.AddRow(row);
      row_.time_s += kRow_s;
      row_.p_WB_m[0] += 0.001;
    }
  }
  void Place() {
    ++row_.segment;
    row_.fallen = false;
    start_x_m_ = row_.p_WB_m[0];
  }
  logs::LogRow row_;

 private:
  double start_x_m_ = 0.0;
};

void DriftTwoPercent(logs::LogRow& row, double x_m) {
  row.est_p_WB_m[0] += 0.012 * x_m;
  row.est_p_WB_m[1] -= 0.016 * x_m;
  row.est_p_WB_m[2] -= 0.005 * x_m;
}

TEST(Estimation, DriftIsAShareOfTheDistance) {
  EstimationAccumulator e;
  Walk walk;
  walk.Run(e, 30.0, DriftTwoPercent);
  const EstimationMetrics m = e.Finish();
  ASSERT_EQ(m.segments.size(), 1u);
  EXPECT_NEAR(m.segments[0].distance_m, 30.0, 2e-3);
  EXPECT_NEAR(m.segments[0].horizontal_pct, 2.0, 1e-6);
  EXPECT_NEAR(m.segments[0].vertical_pct, -0.5, 1e-6);
  EXPECT_NEAR(m.segments[0].yaw_deg_per_m, 0.0, 1e-9);
  EXPECT_TRUE(m.present);
}

TEST(Estimation, OffsetsOfTheStartAreNoDrift) {
  EstimationAccumulator e;
  Walk walk;
  walk.Run(e, 25.0, [](logs::LogRow& row, double x_m) {
    row.est_rpy_rad[2] = 0.3;
    row.est_p_WB_m = {7.0 + std::cos(0.3) * x_m, 1.0 + std::sin(0.3) * x_m, 5.0};
  });
  const EstimationMetrics m = e.Finish();
  ASSERT_EQ(m.segments.size(), 1u);
  EXPECT_NEAR(m.segments[0].horizontal_pct, 0.0, 1e-6);
  EXPECT_NEAR(m.segments[0].yaw_deg_per_m, 0.0, 1e-9);
  EXPECT_NEAR(m.rpe_1m.horizontal_rms_m, 0.0, 1e-9);
}

TEST(Estimation, RelativeErrorsOfAConstantScaleAreItsShares) {
  EstimationAccumulator e;
  Walk walk;
  walk.Run(e, 30.0, DriftTwoPercent);
  const EstimationMetrics m = e.Finish();
  EXPECT_NEAR(m.rpe_1m.horizontal_rms_m, 0.02, 1e-3);  // stretches are longer by up to 0.1 m
  EXPECT_NEAR(m.rpe_10m.horizontal_rms_m, 0.20, 2e-3);
  EXPECT_NEAR(m.rpe_10m.vertical_rms_m, 0.05, 1e-3);
  EXPECT_NEAR(static_cast<double>(m.rpe_1m.stretches), 58.0, 2.0);  // one every half metre
  EXPECT_NEAR(static_cast<double>(m.rpe_10m.stretches), 40.0, 2.0);
}

/// The estimator walks on an arc of curvature k: after L it is off by 2 sin(kL/2)/k on a chord that
/// points kL/2 to the side, whatever its heading at the start.
TEST(Estimation, RelativeErrorsOfAYawDriftAreThoseOfAnArc) {
  constexpr double k = 1.0 * kPerMetre;
  EstimationAccumulator e;
  Walk walk;
  walk.Run(e, 60.0, [](logs::LogRow& row, double x_m) {
    row.est_rpy_rad[2] = k * x_m;
    row.est_p_WB_m[0] = std::sin(k * x_m) / k;
    row.est_p_WB_m[1] = (1.0 - std::cos(k * x_m)) / k;
  });
  const EstimationMetrics m = e.Finish();
  const auto expected = [](double length_m) {
    return std::hypot(std::sin(k * length_m) / k - length_m, (1.0 - std::cos(k * length_m)) / k);
  };
  EXPECT_NEAR(m.rpe_1m.horizontal_rms_m, expected(1.0), 0.05 * expected(1.0));
  EXPECT_NEAR(m.rpe_10m.horizontal_rms_m, expected(10.0), 0.02 * expected(10.0));
  ASSERT_EQ(m.segments.size(), 1u);
  EXPECT_NEAR(m.segments[0].yaw_deg_per_m, 1.0, 1e-4);
  EXPECT_NEAR(m.segments[0].horizontal_pct, 100.0 * expected(60.0) / 60.0, 0.1);
}

TEST(Estimation, SegmentsEndAtPlacementsAndFalls) {
  EstimationAccumulator e;
  Walk walk;
  walk.Run(e, 24.0, DriftTwoPercent);
  walk.Place();  // stuck, set on
  walk.Run(e, 10.0, DriftTwoPercent);
  walk.Place();
  walk.Run(e, 30.0, [](logs::LogRow& row, double x_m) {
    row.est_p_WB_m[1] += 0.01 * x_m + (x_m > 29.6 ? 5.0 : 0.0);  // lost while tumbling
  });
  walk.row_.fallen = true;
  walk.Run(e, 0.2, [](logs::LogRow&, double) {});
  walk.Place();
  walk.Run(e, 0.6, DriftTwoPercent);
  const EstimationMetrics m = e.Finish();
  ASSERT_EQ(m.segments.size(), 3u);
  EXPECT_EQ(m.stub_segments, 1);
  EXPECT_NEAR(m.segments[0].horizontal_pct, 2.0, 1e-6);
  EXPECT_NEAR(m.segments[1].distance_m, 10.0, 2e-3);
  EXPECT_NEAR(m.segments[2].horizontal_pct, 1.0, 1e-6);
  EXPECT_LT(m.rpe_1m.horizontal_rms_m, 0.03);
  const DriftSummary d = SummariseDrift(m);
  EXPECT_EQ(d.segments, 2);
  EXPECT_EQ(d.short_segments, 2);
  EXPECT_FALSE(d.used_short);
  EXPECT_NEAR(d.horizontal_pct, 1.5, 1e-6);
}

TEST(Estimation, ShortSegmentsCountWhereThereAreNoLongOnes) {
  EstimationAccumulator e;
  Walk walk;
  walk.Run(e, 5.0, DriftTwoPercent);
  const DriftSummary d = SummariseDrift(e.Finish());
  EXPECT_TRUE(d.used_short);
  EXPECT_EQ(d.segments, 1);
  EXPECT_NEAR(d.horizontal_pct, 2.0, 1e-6);
}

TEST(Estimation, ErrorsAndConsistencyAreMeans) {
  EstimationAccumulator e;
  Walk walk;
  long i = 0;
  const auto spoil = [&i](logs::LogRow& row, double) {
    const bool even = i++ % 2 == 0;
    row.est_v_WB_mps[1] += 0.03;
    row.est_rpy_rad[0] += 0.01;
    row.est_rpy_rad[1] += even ? 0.02 : -0.02;
    row.nees = even ? 4.0 : 8.0;
    row.nis = even ? 9.0 : 0.0;
    row.nis_dof = even ? 6 : 0;
    row.true_contact = {true, true, false, false};
    row.f_F_W_N[2] = row.f_F_W_N[5] = 70.0;
    row.est_f_F_W_N[2] = row.est_f_F_W_N[5] = 76.0;
    row.est_f_F_W_N[8] = row.est_f_F_W_N[11] = -3.0;
  };
  walk.Run(e, 2.0, spoil);
  walk.row_.fallen = true;
  walk.Run(e, 1.0, [](logs::LogRow& row, double) { row.nees = 1e6; });
  const EstimationMetrics m = e.Finish();
  EXPECT_NEAR(m.nees_ratio, 6.0 / 5.0, 1e-12);
  EXPECT_EQ(m.nees_rows, 2000u);
  EXPECT_NEAR(m.nis_ratio, 1.5, 1e-12);
  EXPECT_EQ(m.nis_rows, 1000u);
  EXPECT_EQ(m.nis_dof, 6000u);
  EXPECT_NEAR(m.roll_rmse_rad, 0.01, 1e-12);
  EXPECT_NEAR(m.pitch_rmse_rad, 0.02, 1e-12);
  EXPECT_NEAR(m.force_stance_rmse_N, 6.0, 1e-9);
  EXPECT_NEAR(m.force_swing_rmse_N, 3.0, 1e-9);
  EXPECT_NEAR(m.velocity_rmse_mps, 0.03, 2e-3);  // and a little of the attitude
}

TEST(Estimation, YawErrorIsNoErrorOfBodyVelocity) {
  EstimationAccumulator e;
  Walk walk;
  walk.Run(e, 2.0, [](logs::LogRow& row, double) {
    row.est_rpy_rad[2] = 0.5;
    row.est_v_WB_mps = {0.5 * std::cos(0.5), 0.5 * std::sin(0.5), 0.0};
  });
  EXPECT_NEAR(e.Finish().velocity_rmse_mps, 0.0, 1e-9);
}

TEST(Estimation, TheTruthItselfIsNoEstimate) {
  EstimationAccumulator e, none;
  Walk walk, other;
  walk.Run(e, 3.0, [](logs::LogRow&, double) {});
  EXPECT_FALSE(e.Finish().present);
  other.Run(none, 3.0, [](logs::LogRow& row, double) {
    row.est_p_WB_m = row.est_v_WB_mps = row.est_rpy_rad = {};
  });
  const EstimationMetrics m = none.Finish();
  EXPECT_FALSE(m.present);
  EXPECT_EQ(m.rows, 0u);
}

TEST(Estimation, EpisodesAddUp) {
  EstimationAccumulator whole, first, second;
  Walk walk, one, two;
  const Walk::Spoil other = [](logs::LogRow& row, double x_m) {
    row.est_p_WB_m[1] += 0.1 * x_m;
    row.est_rpy_rad[0] += 0.05;
    row.nees = 7.0;
  };
  walk.Run(whole, 30.0, DriftTwoPercent);
  walk.Place();
  walk.Run(whole, 21.0, other);
  one.Run(first, 30.0, DriftTwoPercent);
  two.Run(second, 21.0, other);
  EstimationMetrics sum = first.Finish();
  sum += second.Finish();
  const EstimationMetrics m = whole.Finish();
  EXPECT_EQ(sum.segments.size(), m.segments.size());
  EXPECT_EQ(sum.rows, m.rows);
  EXPECT_NEAR(sum.rpe_1m.horizontal_rms_m, m.rpe_1m.horizontal_rms_m, 1e-6);
  EXPECT_NEAR(sum.roll_rmse_rad, m.roll_rmse_rad, 1e-12);
  EXPECT_NEAR(sum.nees_ratio, m.nees_ratio, 1e-12);
}

TEST(Estimation, HeightAndPointsOfTheEstimatorAreBroughtBack) {
  logs::LogRow row;
  EXPECT_EQ(HeightDrift(row), 0.0);
  row.p_WB_m = {1.0, 2.0, 0.30};
  EXPECT_EQ(HeightDrift(row), 0.0);  // no estimate
  row.est_p_WB_m = {1.5, 2.0, 0.25};
  row.est_rpy_rad[2] = M_PI / 2.0;
  EXPECT_NEAR(HeightDrift(row), -0.05, 1e-12);
  const Vec3 p = FromEstimatorFrame(row, {1.5, 2.2, 0.0});  // 0.2 m ahead of the estimated trunk
  EXPECT_NEAR((p - Vec3(1.2, 2.0, 0.05)).norm(), 0.0, 1e-12);
}

TEST(Estimation, DriftIsNotChargedAsTrackingError) {
  MetricsAccumulator m(9.81);
  logs::LogRow row;
  row.operating = true;
  row.cmd_v_x_mps = 0.5;
  for (int i = 0; i < 5000; ++i) {
    row.time_s = kRow_s * i;
    row.p_WB_m = {0.5 * row.time_s, 0.0, 0.30};
    row.est_p_WB_m = {0.5 * row.time_s, 0.0, 0.30 - 0.02 * row.time_s};
    row.com_z_m = 0.29;
    row.ref_p_WC_m[2] = 0.28 - 0.02 * row.time_s;  // the estimator's frame sinks
    m.AddRow(row, {});
  }
  const EpisodeMetrics r = m.Finish();
  EXPECT_NEAR(r.tracking.height_rmse_m, 0.01, 1e-9);
  EXPECT_TRUE(r.estimation.present);
}

logs::LogRow SpoiltRow(long i) {
  const auto stance = [](long row) { return row >= 0 && (row / 100) % 2 == 1; };
  logs::LogRow row;
  row.operating = true;
  row.time_s = kRow_s * static_cast<double>(i);
  row.p_WB_m = {0.001 * static_cast<double>(i), 0.0, 0.3};
  row.est_p_WB_m = {0.00102 * static_cast<double>(i), 0.0, 0.3};
  row.nees = 5.0;
  row.nis = 6.0;
  row.nis_dof = 6;
  row.true_contact.fill(stance(i));
  row.contact_sensor.fill(stance(i - 3));
  row.contact = row.contact_sensor;
  row.sensor_counts.fill(stance(i) ? 50.0 : static_cast<double>(i % 7));
  row.observer_probability.fill(stance(i) ? 0.9 : 0.2);
  return row;
}

TEST(Estimation, MemoryDoesNotGrowWithTheEpisode) {
  if (!test::AllocationGuard::IsArmed()) GTEST_SKIP();
  EstimationAccumulator e;
  for (long i = 0; i < 1000; ++i) e.AddRow(SpoiltRow(i));  // its window of rows finds its size
  const test::AllocationGuard guard;
  for (long i = 1000; i < 50000; ++i) e.AddRow(SpoiltRow(i));
  EXPECT_EQ(guard.count(), 0);
}

TEST(Estimation, SurvivesTheJsonRoundTrip) {
  EstimationAccumulator e;
  for (long i = 0; i < 30000; ++i) e.AddRow(SpoiltRow(i));
  const EstimationMetrics m = e.Finish();
  const nlohmann::json j = m;
  const auto again = j.get<EstimationMetrics>();
  EXPECT_EQ(nlohmann::json(again), j);
  EXPECT_EQ(again.contact, m.contact);
  EXPECT_EQ(again.segments.size(), 1u);
  nlohmann::json spoilt = j;
  spoilt["contact"]["sensor_evidence"]["stance"] = "999:1";
  try {
    (void)spoilt.get<EstimationMetrics>();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "bins: \"999:1\": expected bin:count with bin < 256");
  }
}

TEST(Estimation, OlderResultsHaveNone) {
  nlohmann::json j = EpisodeMetrics{};
  j.erase("estimation");
  EXPECT_FALSE(j.get<EpisodeMetrics>().estimation.present);
}

}  // namespace
}  // namespace scoria::analysis
