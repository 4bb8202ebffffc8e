// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/trajectory_error.h"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/math/so3.h"
#include "core/rng.h"

namespace scoria::analysis {
namespace {

/// A point of a curved path of about 20 m.
Vec3 PathAt(int k) {
  const double s = 0.01 * k;
  return {10.0 * std::sin(0.2 * s), 3.0 * std::sin(0.5 * s), 0.1 * std::sin(s)};
}
constexpr int kPoints = 1500;

TEST(TrajectoryError, YawAndTranslationAreNoError) {
  TrajectoryErrorAccumulator accumulator;
  for (int k = 0; k < kPoints; ++k) {
    const Vec3 p = PathAt(k);
    accumulator.Add({p, core::RotationZ(2.0) * p + Vec3(30.0, -20.0, 4.0), 0.0, 2.0});
  }
  const TrajectoryError error = accumulator.Finish();
  EXPECT_EQ(error.Refusal(), "");
  EXPECT_LT(error.ate_m, 1e-6);
  EXPECT_LT(error.rpe_1m.horizontal_rms_m, 1e-9);
  EXPECT_GT(error.rpe_1m.stretches, 5u);
}

/// The yaw that leaves least, by trying all.
TEST(TrajectoryError, IsTheLeastThatAnyYawLeaves) {
  core::Rng rng(5, 0, core::Stream::kSensor);
  std::vector<PosePair> pairs;
  Vec3 mean_true = Vec3::Zero(), mean_est = Vec3::Zero();
  TrajectoryErrorAccumulator accumulator;
  for (int k = 0; k < kPoints; ++k) {
    PosePair pair;
    pair.p_true = PathAt(k);
    const Vec3 noise(rng.NextNormal(), rng.NextNormal(), rng.NextNormal());
    pair.p_est = core::RotationZ(-1.0) * (1.05 * pair.p_true + 0.1 * noise) + Vec3(5.0, 6.0, 7.0);
    accumulator.Add(pair);
    pairs.push_back(pair);
    mean_true += pair.p_true / kPoints, mean_est += pair.p_est / kPoints;
  }
  double least = HUGE_VAL, horizontal = 0.0;
  for (double yaw = 0.9; yaw < 1.1; yaw += 1e-4) {
    double squares = 0.0, flat = 0.0;
    for (const PosePair& pair : pairs) {
      const Vec3 e = core::RotationZ(yaw) * (pair.p_est - mean_est) - (pair.p_true - mean_true);
      squares += e.squaredNorm() / kPoints, flat += e.head<2>().squaredNorm() / kPoints;
    }
    if (squares < least) least = squares, horizontal = flat;
  }
  const TrajectoryError error = accumulator.Finish();
  EXPECT_NEAR(error.ate_m, std::sqrt(least), 1e-6);
  EXPECT_NEAR(error.ate_horizontal_m, std::sqrt(horizontal), 1e-6);
}

TEST(TrajectoryError, StretchesAreAlignedEachByItself) {
  TrajectoryErrorAccumulator accumulator;
  for (int k = 0; k < kPoints; ++k) {
    if (k == kPoints / 2) accumulator.Break();
    const Vec3 moved = k < kPoints / 2 ? Vec3::Zero() : Vec3(8.0, 0.0, 0.0);
    accumulator.Add({PathAt(k), PathAt(k) + moved, 0.0, 0.0});
  }
  const TrajectoryError error = accumulator.Finish();
  EXPECT_EQ(error.stretches, 2);
  EXPECT_LT(error.ate_m, 1e-6);
}

TEST(TrajectoryError, RowsCountWhileTheRobotWalksAndPlacementsEndAStretch) {
  TrajectoryErrorAccumulator accumulator;
  for (int k = 0; k < kPoints; ++k) {
    const bool is_placed = k >= kPoints / 2, is_fallen = k > kPoints / 2 - 100 && !is_placed;
    const Vec3 p = PathAt(k), q = p + (is_placed ? Vec3(8.0, 0.0, 0.0) : Vec3::Zero());
    logs::Row row;
    row.episode.emplace();
    row.episode->operating = true;
    row.episode->fallen = is_fallen;
    row.episode->segment = is_placed ? 1 : 0;
    row.truth.emplace().p_WB_m = {p.x(), p.y(), p.z()};
    row.estimate.emplace().p_WB_m = {q.x(), q.y(), is_fallen ? 5.0 : q.z()};
    accumulator.AddRow(row);
  }
  const TrajectoryError error = accumulator.Finish();
  EXPECT_EQ(error.stretches, 2);
  EXPECT_EQ(error.samples, static_cast<std::uint64_t>(kPoints - 99));
  EXPECT_LT(error.ate_m, 1e-6);
}

TEST(TrajectoryError, StandingRobotIsRefused) {
  TrajectoryErrorAccumulator accumulator;
  for (int k = 0; k < kPoints; ++k) {
    const double sway = 0.02 * std::sin(0.05 * k);
    accumulator.Add({{sway, 0.0, 0.3}, {0.0, sway, 0.3}, 0.0, 0.0});
  }
  const TrajectoryError error = accumulator.Finish();
  EXPECT_EQ(error.Refusal(),
            "the robot stands: by the truth it is never more than 0.02 m from where it starts, "
            "which tells no yaw to align by");
  EXPECT_EQ(nlohmann::json(error).at("refusal"), error.Refusal());
}

TEST(TrajectoryError, NothingToCompareIsRefused) {
  EXPECT_EQ(TrajectoryErrorAccumulator().Finish().Refusal(),
            "the log has no instant with both truth and estimate");
}

}  // namespace
}  // namespace scoria::analysis
