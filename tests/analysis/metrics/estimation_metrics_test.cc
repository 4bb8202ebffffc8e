// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/estimation_metrics.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "analysis/metrics/metrics.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/rows.h"

namespace scoria::analysis {
namespace {

using test::kRow_s;
constexpr double kPerMetre = M_PI / 180.0;  // rad, one degree

/// A walk along +x at 0.5 m/s with a perfect estimate, to be spoiled row by row.
class Walk {
 public:
  using Spoil = std::function<void(logs::Row&, double x_m)>;
  Walk() {
    row_.episode->operating = true;
    row_.episode->segment = 1;
    row_.truth->p_WB_m = {3.0, -2.0, 0.3};
    row_.truth->v_WB_mps = {0.5, 0.0, 0.0};
    start_x_m_ = row_.truth->p_WB_m[0];
  }
  void Run(EstimationAccumulator& e, double metres, const Spoil& spoil) {
    for (long i = std::lround(metres / 0.001); i > 0; --i) {
      logs::Row row = row_;
      row.estimate->p_WB_m = row.truth->p_WB_m;
      row.estimate->v_WB_mps = row.truth->v_WB_mps;
      row.estimate->rpy_rad = row.truth->rpy_rad;
      spoil(row, row_.truth->p_WB_m[0] - start_x_m_);
      e.AddRow(row);
      row_.time_s += kRow_s;
      row_.truth->p_WB_m[0] += 0.001;
    }
  }
  void Place() {
    ++row_.episode->segment;
    row_.episode->fallen = false;
    start_x_m_ = row_.truth->p_WB_m[0];
  }
  logs::Row row_ = test::WholeRow();

 private:
  double start_x_m_ = 0.0;
};

/// A covariance that knows the speed to the side to `sigma_mps`, and nothing else.
std::array<double, 15> CovarianceOfSideways(double sigma_mps) {
  constexpr double kUnknown = 1e12;
  std::array<double, 15> P{};
  for (const std::size_t diagonal : {0, 2, 5, 9, 14}) P[diagonal] = kUnknown;
  P[9] = sigma_mps * sigma_mps;
  return P;
}

void DriftTwoPercent(logs::Row& row, double x_m) {
  row.estimate->p_WB_m[0] += 0.012 * x_m;
  row.estimate->p_WB_m[1] -= 0.016 * x_m;
  row.estimate->p_WB_m[2] -= 0.005 * x_m;
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
  walk.Run(e, 25.0, [](logs::Row& row, double x_m) {
    row.estimate->rpy_rad[2] = 0.3;
    row.estimate->p_WB_m = {7.0 + std::cos(0.3) * x_m, 1.0 + std::sin(0.3) * x_m, 5.0};
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
  walk.Run(e, 60.0, [](logs::Row& row, double x_m) {
    row.estimate->rpy_rad[2] = k * x_m;
    row.estimate->p_WB_m[0] = std::sin(k * x_m) / k;
    row.estimate->p_WB_m[1] = (1.0 - std::cos(k * x_m)) / k;
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
  walk.Run(e, 30.0, [](logs::Row& row, double x_m) {
    row.estimate->p_WB_m[1] += 0.01 * x_m + (x_m > 29.6 ? 5.0 : 0.0);  // lost while tumbling
  });
  walk.row_.episode->fallen = true;
  walk.Run(e, 0.2, [](logs::Row&, double) {});
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
  const auto spoil = [&i](logs::Row& row, double) {
    const bool even = i++ % 2 == 0;
    row.estimate->v_WB_mps[1] += 0.03;
    row.estimate->rpy_rad[0] += 0.01;
    row.estimate->rpy_rad[1] += even ? 0.02 : -0.02;
    row.estimate->P_tilt_v = CovarianceOfSideways(even ? 0.03 / 2.0 : 0.03 / std::sqrt(8.0));
    if (even) row.estimate->innovation = {9.0, 6};
    row.true_contacts->contact = {true, true, false, false};
    logs::Array12& f_F_W_N = *row.true_contacts->f_F_W_N;
    f_F_W_N[2] = f_F_W_N[5] = 70.0;
    row.contacts->f_F_W_N.value()[2] = row.contacts->f_F_W_N.value()[5] = 76.0;
    row.contacts->f_F_W_N.value()[8] = row.contacts->f_F_W_N.value()[11] = -3.0;
  };
  walk.Run(e, 2.0, spoil);
  walk.row_.episode->fallen = true;
  walk.Run(e, 1.0,
           [](logs::Row& row, double) { row.estimate->P_tilt_v = CovarianceOfSideways(1e-9); });
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
  walk.Run(e, 2.0, [](logs::Row& row, double) {
    row.estimate->rpy_rad[2] = 0.5;
    row.estimate->v_WB_mps = {0.5 * std::cos(0.5), 0.5 * std::sin(0.5), 0.0};
  });
  EXPECT_NEAR(e.Finish().velocity_rmse_mps, 0.0, 1e-9);
}

TEST(Estimation, TheTruthItselfIsNoEstimate) {
  EstimationAccumulator e, none;
  Walk walk, other;
  walk.Run(e, 3.0, [](logs::Row&, double) {});
  EXPECT_FALSE(e.Finish().present);
  other.Run(none, 3.0, [](logs::Row& row, double) { row.estimate.reset(); });
  const EstimationMetrics m = none.Finish();
  EXPECT_FALSE(m.present);
  EXPECT_EQ(m.rows, 0u);
}

TEST(Estimation, EpisodesAddUp) {
  EstimationAccumulator whole, first, second;
  Walk walk, one, two;
  const Walk::Spoil other = [](logs::Row& row, double x_m) {
    row.estimate->p_WB_m[1] += 0.1 * x_m;
    row.estimate->rpy_rad[0] += 0.05;
    row.estimate->v_WB_mps[1] += 0.1;
    row.estimate->P_tilt_v = CovarianceOfSideways(0.04);
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
  logs::Row row;
  row.truth = {.p_WB_m = {1.0, 2.0, 0.30}};
  EXPECT_FALSE(HeightDrift(row).has_value());
  EXPECT_FALSE(FromEstimatorFrame(row, Vec3::Zero()).has_value());
  row.estimate.emplace();
  row.estimate->p_WB_m = {1.5, 2.0, 0.25};
  row.estimate->rpy_rad[2] = M_PI / 2.0;
  EXPECT_NEAR(HeightDrift(row).value(), -0.05, 1e-12);
  const Vec3 p =
      FromEstimatorFrame(row, {1.5, 2.2, 0.0}).value();  // 0.2 m ahead of the estimated trunk
  EXPECT_NEAR((p - Vec3(1.2, 2.0, 0.05)).norm(), 0.0, 1e-12);
}

TEST(Estimation, DriftIsNotChargedAsTrackingError) {
  MetricsAccumulator m(9.81);
  logs::Row row = test::WholeRow();
  row.episode->operating = true;
  row.command->v_x_mps = 0.5;
  for (int i = 0; i < 5000; ++i) {
    row.time_s = kRow_s * i;
    row.truth->p_WB_m = {0.5 * row.time_s, 0.0, 0.30};
    row.estimate->p_WB_m = {0.5 * row.time_s, 0.0, 0.30 - 0.02 * row.time_s};
    row.true_mass->p_WC_z_m = 0.29;
    row.reference->p_WC_m[2] = 0.28 - 0.02 * row.time_s;  // the estimator's frame sinks
    m.AddRow(row);
  }
  const EpisodeMetrics r = m.Finish();
  EXPECT_NEAR(r.tracking.height_rmse_m.value(), 0.01, 1e-9);
  EXPECT_TRUE(r.estimation.present);
}

logs::Row SpoiltRow(long i) {
  const auto stance = [](long row) { return row >= 0 && (row / 100) % 2 == 1; };
  logs::Row row = test::WholeRow();
  row.episode->operating = true;
  row.time_s = kRow_s * static_cast<double>(i);
  row.truth->p_WB_m = {0.001 * static_cast<double>(i), 0.0, 0.3};
  row.estimate->p_WB_m = {0.00102 * static_cast<double>(i), 0.0, 0.3};
  row.estimate->P_tilt_v = CovarianceOfSideways(0.01);
  row.estimate->innovation = {6.0, 6};
  row.true_contacts->contact.fill(stance(i));
  row.contacts->sensor->contact.fill(stance(i - 3));
  row.contacts->contact = row.contacts->sensor->contact;
  row.contacts->sensor->counts.fill(stance(i) ? 50.0 : static_cast<double>(i % 7));
  row.contacts->observer->probability.fill(stance(i) ? 0.9 : 0.2);
  return row;
}

TEST(Estimation, MemoryDoesNotGrowWithTheEpisode) {
  if (!test::AllocationGuard::IsArmed()) GTEST_SKIP() << "the sanitizer owns the allocator";
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
