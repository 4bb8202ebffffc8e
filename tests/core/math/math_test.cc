// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/math/cholesky.h"
#include "core/math/moving_mean.h"
#include "core/math/so3.h"
#include "core/rng.h"

namespace scoria::core {
namespace {

Vec3 Random(Rng& rng, double size) {
  return {rng.NextUniform(-size, size), rng.NextUniform(-size, size), rng.NextUniform(-size, size)};
}

TEST(So3, ExpAndLogInvertEachOtherFromTinyToPi) {
  Rng rng(1, 0, Stream::kSensor);
  for (const double size : {1e-9, 1e-5, 1e-4, 0.1, 1.0, 1.7}) {
    for (int i = 0; i < 50; ++i) {
      const Vec3 phi = Random(rng, size);
      const Mat3 R = ExpSo3(phi);
      EXPECT_LT((R * R.transpose() - Mat3::Identity()).norm(), 1e-14);
      EXPECT_LT((LogSo3(R) - phi).norm(), 1e-12 + 1e-8 * size * size) << size;
    }
  }
  const Vec3 half_turn(0.0, std::numbers::pi, 0.0);
  EXPECT_NEAR(LogSo3(ExpSo3(half_turn)).norm(), std::numbers::pi, 1e-9);
}

TEST(So3, ExpDerivativeIsSkewAtIdentity) {
  const Vec3 w(0.3, -0.2, 0.5);
  constexpr double kStep = 1e-6;
  EXPECT_LT(((ExpSo3(kStep * w) - ExpSo3(-kStep * w)) / (2 * kStep) - Skew(w)).norm(), 1e-9);
}

TEST(So3, RollPitchYawRoundTrip) {
  Rng rng(2, 0, Stream::kSensor);
  for (int i = 0; i < 200; ++i) {
    const Vec3 rpy = Random(rng, 1.5);
    EXPECT_LT((RpyFromRotation(RotationFromRpy(rpy)) - rpy).norm(), 1e-12);
  }
  EXPECT_LT((RotationFromRpy({0, 0, 0.4}) - RotationZ(0.4)).norm(), 1e-15);
}

TEST(So3, UnwrapStaysNear) {
  EXPECT_NEAR(UnwrapNear(-3.1, 3.1), -3.1 + 2 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(UnwrapNear(0.2, 12.5), 0.2 + 4 * std::numbers::pi, 1e-12);
}

TEST(SmallCholesky, SolvesLikeEigen) {
  Rng rng(3, 0, Stream::kSensor);
  Mat6 M;
  for (double& x : M.reshaped()) x = rng.NextNormal();
  const Mat6 A = M * M.transpose() + Mat6::Identity();
  Vec6 b;
  for (double& x : b) x = rng.NextNormal();
  Mat6 L = A;
  ASSERT_TRUE(FactorCholesky<6>(L));
  Vec6 x = b;
  SolveLower<6, 1>(L, x);
  SolveLowerTransposed<6>(L, x);
  EXPECT_LT((A * x - b).norm(), 1e-12);
  Mat6 indefinite = -A;
  EXPECT_FALSE(FactorCholesky<6>(indefinite));
}

TEST(MovingMean, AveragesTheLastSamplesOnly) {
  MovingMean<double, 8> mean(3);
  EXPECT_EQ(mean.Update(1.0), 1.0);
  EXPECT_EQ(mean.Update(3.0), 2.0);
  EXPECT_EQ(mean.Update(5.0), 3.0);
  EXPECT_EQ(mean.Update(10.0), 6.0);
}

}  // namespace
}  // namespace scoria::core
