// SPDX-License-Identifier: BSD-3-Clause
#include "core/math/spatial_inertia.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "core/rng.h"

namespace scoria::core {
namespace {

/// A cloud of point masses, of which everything can be summed by hand.
struct Cloud {
  std::vector<double> mass_kg;
  std::vector<Vec3> p_O;

  [[nodiscard]] SpatialInertia inertia() const {
    SpatialInertia out;
    for (std::size_t i = 0; i < p_O.size(); ++i) {
      out.mass_kg += mass_kg[i];
      out.p_OC += mass_kg[i] * p_O[i];
    }
    out.p_OC /= out.mass_kg;
    out.I_C = About(out.p_OC);
    return out;
  }
  [[nodiscard]] Mat3 About(const Vec3& point) const {
    Mat3 I = Mat3::Zero();
    for (std::size_t i = 0; i < p_O.size(); ++i) {
      const Mat3 S = Skew(p_O[i] - point);
      I -= mass_kg[i] * S * S;
    }
    return I;
  }
};

Vec3 Point(Rng& rng) { return {rng.NextNormal(), rng.NextNormal(), rng.NextNormal()}; }

Cloud SampleCloud(Rng& rng) {
  Cloud out;
  for (int i = 0; i < 6; ++i) {
    out.mass_kg.push_back(0.1 + rng.NextUniform());
    out.p_O.push_back(Point(rng));
  }
  return out;
}

double Distance(const SpatialInertia& a, const SpatialInertia& b) {
  return std::abs(a.mass_kg - b.mass_kg) + (a.p_OC - b.p_OC).norm() + (a.I_C - b.I_C).norm();
}

TEST(SpatialInertia, ParallelAxisTheoremGivesTheInertiaAboutAnyPoint) {
  Rng rng(71, 0, Stream::kSensor);
  for (int trial = 0; trial < 50; ++trial) {
    const Cloud cloud = SampleCloud(rng);
    const SpatialInertia body = cloud.inertia();
    const Vec3 point = Point(rng);
    const Mat3 about = body.I_C + PointInertia(body.mass_kg, body.p_OC - point);
    EXPECT_LT((about - cloud.About(point)).norm(), 1e-12);
  }
}

TEST(SpatialInertia, JoinedBodiesAreTheBodyOfAllTheirPoints) {
  Rng rng(72, 0, Stream::kSensor);
  for (int trial = 0; trial < 50; ++trial) {
    const Cloud a = SampleCloud(rng), b = SampleCloud(rng);
    Cloud all = a;
    all.mass_kg.insert(all.mass_kg.end(), b.mass_kg.begin(), b.mass_kg.end());
    all.p_O.insert(all.p_O.end(), b.p_O.begin(), b.p_O.end());
    EXPECT_LT(Distance(Join(a.inertia(), b.inertia()), all.inertia()), 1e-12);
  }
  const SpatialInertia body = SampleCloud(rng).inertia();
  EXPECT_LT(Distance(Join(body, {}), body), 1e-14) << "nothing adds nothing";
}

TEST(SpatialInertia, AnotherFrameSeesTheSamePoints) {
  Rng rng(73, 0, Stream::kSensor);
  for (int trial = 0; trial < 50; ++trial) {
    const Cloud cloud = SampleCloud(rng);
    const Mat3 R_PO = ExpSo3(Point(rng));
    const Vec3 p_PO = Point(rng);
    Cloud moved = cloud;
    for (Vec3& p : moved.p_O) p = p_PO + R_PO * p;
    EXPECT_LT(Distance(Transform(R_PO, p_PO, cloud.inertia()), moved.inertia()), 1e-12);
  }
}

}  // namespace
}  // namespace scoria::core
