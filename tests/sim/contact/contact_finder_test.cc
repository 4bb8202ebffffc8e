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

}  // namespace
}  // namespace scoria::sim
