// SPDX-License-Identifier: BSD-3-Clause
#include "app/operator.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/math/so3.h"
#include "tests/support/robots.h"

namespace scoria::app {
namespace {

TEST(Route, LeadsAroundAWallThroughItsGap) {
  // A wall 0.3 m high across the loop at x > 0, y near 3, with a gap at x in [7, 9].
  constexpr int kNodes = 301;
  std::vector<double> heights;
  for (int row = 0; row < kNodes; ++row) {
    for (int column = 0; column < kNodes; ++column) {
      const double x = (column - 150) * 0.1, y = (row - 150) * 0.1;
      const bool wall = std::abs(y - 3.0) < 0.3 && x > 0.0 && (x < 7.0 || x > 9.0);
      heights.push_back(wall ? 0.3 : 0.0);
    }
  }
  const terrains::Heightfield ground(kNodes, 0.1, std::move(heights), {});
  const Route route = PlanRoute({}, test::Go2(), ground);
  ASSERT_GT(route.size(), 100u);
  for (const Vec2& p : route) EXPECT_LT(ground.HeightAt(p.x(), p.y()), 0.1) << p.transpose();
  for (std::size_t i = 0; i < route.size(); ++i) {
    EXPECT_LT((route[(i + 1) % route.size()] - route[i]).norm(), 0.3)
        << "the loop has no gap at " << i;
  }
}

TEST(Operator, LeadsAnIdealRobotAroundTheLoop) {
  const terrains::Heightfield ground = test::FlatGround(0.8, 30.0);
  RouteParams params;
  params.speed_mps = 0.5;
  Operator person(params, test::Go2(), ground);
  RobotState s;
  s.p_WB.head<2>() = person.start().p_WB;
  double yaw = person.start().yaw_rad;
  const double dt = 0.01;
  double walked = 0.0, worst = 0.0;
  for (int i = 0; i < 12000; ++i) {
    s.R_WB = core::RotationZ(yaw);
    const Command c = person.Update(s, i * dt, dt);
    yaw += c.w_z_radps * dt;
    s.p_WB += dt * c.v_x_mps * Vec3(std::cos(yaw), std::sin(yaw), 0.0);
    walked += dt * c.v_x_mps;
    worst = std::max(worst, std::abs(s.p_WB.head<2>().norm() - params.loop_radius_m));
  }
  EXPECT_GT(walked, 50.0);
  EXPECT_LT(worst, 1.5) << "stays near the circle";
}

TEST(Operator, FollowsTheVelocityProgramme) {
  VelocityProgramme programme;
  programme.steps = {{0.0, 0.1, 0.0, 0.0}, {2.0, 0.0, 0.2, -0.3}};
  Operator person(programme, test::Go2(), test::FlatGround());
  EXPECT_EQ(person.Update({}, 1.0, 0.01).v_x_mps, 0.1);
  EXPECT_EQ(person.Update({}, 2.5, 0.01).w_z_radps, -0.3);
}

}  // namespace
}  // namespace scoria::app
