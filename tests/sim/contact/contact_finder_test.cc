// SPDX-License-Identifier: BSD-3-Clause
#include "sim/contact/contact_finder.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "core/rng.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

/// Waves as long as a hand.
terrains::Heightfield Waves() {
  constexpr int kNodes = 201;
  std::vector<double> heights_m;
  for (int row = 0; row < kNodes; ++row) {
    for (int column = 0; column < kNodes; ++column)
      heights_m.push_back(0.02 * std::sin(0.8 * column) * std::cos(0.6 * row));
  }
  return terrains::Heightfield(kNodes, 0.025, std::move(heights_m), {});
}

bool Same(const std::vector<ContactPoint>& a, const std::vector<ContactPoint>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const ContactPoint& p, const ContactPoint& q) {
                      return p.body == q.body && p.is_foot == q.is_foot && p.p_BP_W == q.p_BP_W &&
                             p.n_W == q.n_W && p.gap_m == q.gap_m;
                    });
}

/// A robot that lies on its side and rolls a little from step to step.
std::vector<ContactPoint> FindAt(ContactFinder& finder, int step) {
  const core::RobotDescription& robot = test::Go2();
  RobotState s = test::StandingState();
  s.R_WB = core::ExpSo3(Vec3(1.4 + 0.3 * std::sin(0.01 * step), 0.1 * std::cos(0.017 * step), 0.0));
  s.p_WB = {0.0005 * step, 0.0, 0.09 + 0.03 * std::sin(0.02 * step)};
  std::vector<ContactPoint> contacts;
  finder.Find(core::CalcLinkPoses(robot, s.p_WB, s.R_WB, s.q), s.p_WB, contacts);
  return contacts;
}

// A copy finds the very points, in their order; a fresh finder at the same poses, without the
// points that boxes remember, does not.
TEST(ContactFinder, CopyGoesOnWithTheCachedPoints) {
  const terrains::Heightfield ground = Waves();
  ContactFinder original(test::Go2(), ground);
  bool memory_matters = false;
  std::size_t points = 0;
  for (int step = 0; step < 600; ++step) {
    if (step % 40 == 17) {
      ContactFinder reference(original), copy(original), fresh(test::Go2(), ground);
      for (int ahead = step; ahead < step + 30; ++ahead) {
        const std::vector<ContactPoint> expected = FindAt(reference, ahead);
        ASSERT_TRUE(Same(FindAt(copy, ahead), expected)) << ahead;
        memory_matters = memory_matters || !Same(FindAt(fresh, ahead), expected);
      }
    }
    points += FindAt(original, step).size();
  }
  EXPECT_GT(points, 1000u);
  EXPECT_TRUE(memory_matters);
}

// What copies do leaves the original alone, and outlives it.
TEST(ContactFinder, CopyIsIndependent) {
  const terrains::Heightfield ground = Waves();
  ContactFinder alone(test::Go2(), ground);
  auto original = std::make_unique<ContactFinder>(test::Go2(), ground);
  for (int step = 0; step < 100; ++step) {
    (void)FindAt(alone, step);
    (void)FindAt(*original, step);
  }
  ContactFinder copy(*original), other(*original);
  for (int step = 300; step < 350; ++step) (void)FindAt(other, step);
  original.reset();
  for (int step = 100; step < 200; ++step)
    ASSERT_TRUE(Same(FindAt(copy, step), FindAt(alone, step))) << step;
}

/// The robot with its trunk's box as the hull of eight corners, the upper ones moved in by
/// `slant_m`.
core::RobotDescription WithHull(double slant_m) {
  core::RobotDescription robot = test::Go2();
  core::Shape& trunk = robot.collisions.front();
  trunk.kind = core::Shape::Kind::kHull;
  for (int i = 0; i < 8; ++i) {
    const bool up = i >= 4;
    Vec3 p = 0.5 * trunk.size_m - Vec3(up ? slant_m : 0.0, 0.0, 0.0);
    p = p.cwiseProduct(Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, up ? 1 : -1));
    trunk.hull.push_back(p);
  }
  return robot;
}

/// Gap of the trunk's lowest point to flat ground, turned by `rpy_rad`, 2 mm in it by geometry.
double TrunkGap(const core::RobotDescription& robot, const Vec3& rpy_rad) {
  const terrains::Heightfield ground = test::FlatGround();
  ContactFinder finder(robot, ground);
  const Mat3 R_WB = core::RotationFromRpy(rpy_rad);
  const core::Shape& box = test::Go2().collisions.front();
  const Vec3 half = 0.5 * box.size_m;
  RobotState s = test::StandingState();
  s.R_WB = R_WB;
  s.p_WB.z() = R_WB.row(2).cwiseAbs().dot(half) - R_WB.row(2).dot(box.p_LG) - 0.002;
  std::vector<ContactPoint> contacts;
  finder.Find(core::CalcLinkPoses(robot, s.p_WB, s.R_WB, s.q), s.p_WB, contacts);
  double gap_m = 1.0;
  for (const ContactPoint& c : contacts) {
    if (c.body == 0) gap_m = std::min(gap_m, c.gap_m);
  }
  return gap_m;
}

TEST(ContactFinder, HullOfABoxTouchesWhereTheBoxDoes) {
  constexpr double kRounded_m = 7.5e-4;  // corners by the margin of 1 mm: (3^1/2 - 1) of it
  const core::RobotDescription hull = WithHull(0.0), slanted = WithHull(0.05);
  for (const Vec3& rpy_rad : {Vec3(0, 0, 0), Vec3(0.3, 0.2, 0), Vec3(0.1, -1.2, 0.5),
                              Vec3(3.0, 0.1, 0.0), Vec3(1.5, 0.4, 0.2)}) {
    EXPECT_NEAR(TrunkGap(hull, rpy_rad), -0.002, kRounded_m) << rpy_rad.transpose();
  }
  EXPECT_NEAR(TrunkGap(slanted, {0.3, 0.2, 0.0}), -0.002, kRounded_m) << "on a lower corner";
  EXPECT_GT(TrunkGap(slanted, {3.0, 0.1, 0.0}), 0.002) << "on its back, the corner is not there";
}

}  // namespace
}  // namespace scoria::sim
