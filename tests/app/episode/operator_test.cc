// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/operator.h"

#include <cmath>
#include <functional>

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

using Height = std::function<double(double x, double y)>;

terrains::Heightfield GroundOf(const Height& height) {
  constexpr int kNodes = 601;
  constexpr double kSpacing_m = 0.05;
  std::vector<double> heights;
  for (int row = 0; row < kNodes; ++row) {
    for (int column = 0; column < kNodes; ++column)
      heights.push_back(
          height((column - kNodes / 2) * kSpacing_m, (row - kNodes / 2) * kSpacing_m));
  }
  return {kNodes, kSpacing_m, std::move(heights), {}};
}

// A gully along x across the whole tile, everywhere too deep to be free: 0.5 m, but 0.15 m deep
// near x = 3 and x = -10.
TEST(Route, CrossesAGullyWhereItIsLowest) {
  const terrains::Heightfield ground = GroundOf([](double x, double y) {
    const double depth = std::min(std::abs(x - 3.0), std::abs(x + 10.0)) < 1.0 ? 0.15 : 0.5;
    return -depth * std::max(0.0, 1.0 - std::abs(y) / 0.4);
  });
  int crossings = 0;
  const Route route = PlanRoute({}, test::Go2(), ground);
  for (std::size_t i = 0; i < route.size(); ++i) {
    if (route[i].y() * route[(i + 1) % route.size()].y() > 0.0) continue;
    ++crossings;
    EXPECT_LT(std::min(std::abs(route[i].x() - 3.0), std::abs(route[i].x() + 10.0)), 1.0);
  }
  EXPECT_GE(crossings, 2);
}

// Boulders of 0.3 m on the circle, also where the loop would start.
TEST(Route, GoesAroundBoulders) {
  const auto height = [](double x, double y) {
    const double angle = std::remainder(std::atan2(y, x), 0.19634954);  // 32 of them
    const double away = std::hypot(std::hypot(x, y) - 8.0, 8.0 * angle);
    return std::max(0.0, 0.3 - away);
  };
  const Route route = PlanRoute({}, test::Go2(), GroundOf(height));
  for (const Vec2& p : route) EXPECT_LT(height(p.x(), p.y()), 0.02) << p.transpose();
}

// After a fall the robot is put on the route, ahead of the fall and not on the boulder there.
TEST(Operator, OffersPlacesAheadOnTheRoute) {
  const terrains::Heightfield ground = test::FlatGround(0.8, 30.0);
  const Operator person(RouteParams{}, test::Go2(), ground);
  const Place fall{Vec2(8.1, 0.3), 0.0};  // near the start, looking out of the loop
  const std::vector<Place> places = person.PlacesAhead(fall, 0.5);
  ASSERT_FALSE(places.empty());
  EXPECT_NEAR((places.front().p_WB - Vec2(8.0, 0.3)).norm(), 0.5, 0.2);
  EXPECT_GT(places.front().p_WB.y(), 0.6) << "the loop runs against the clock";
  EXPECT_NEAR(places.front().yaw_rad, 1.96, 0.45) << "along the octagon's edge";
  double furthest_m = 0.0;
  for (const Place& p : places) furthest_m = std::max(furthest_m, (p.p_WB - fall.p_WB).norm());
  EXPECT_GT(furthest_m, 4.0);
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

/// A robot that a slope turns by 0.2 rad/s, led for 20 s. @returns its heading's error at the end.
double ErrorOfHeading(const VelocityProgramme& programme, double expected_rad) {
  Operator person(programme, test::Go2(), test::FlatGround());
  RobotState s;
  double yaw = 1.0;
  constexpr double kDt_s = 0.01;
  for (int i = 0; i < 2000; ++i) {
    s.R_WB = core::RotationZ(yaw);
    yaw += (person.Update(s, i * kDt_s, kDt_s).w_z_radps + 0.2) * kDt_s;
  }
  return core::WrapToPi(yaw - 1.0 - expected_rad);
}

TEST(Operator, SteersBackToTheHeadingsOfAProgramme) {
  VelocityProgramme programme;
  programme.steps = {{0.0, 0.3, 0.0, 0.1}, {10.0, 0.3, 0.0, 0.1}};
  EXPECT_GT(std::abs(ErrorOfHeading(programme, 2.0)), 2.0) << "no heading, no correction";
  programme.steps[0].heading_rad = 0.0;
  programme.steps[1].heading_rad = 4.0;  // over pi, and more than the command turns
  // After the last step the heading goes on as commanded: 4 + 10 * 0.1 rad. What remains is the
  // turn of 0.2 rad/s over the gain.
  EXPECT_NEAR(ErrorOfHeading(programme, 5.0), 0.2 / programme.yaw_gain_per_s, 0.01);
}

TEST(Operator, CorrectsNoHeadingWhereTheRobotIsToStand) {
  VelocityProgramme programme;
  programme.steps = {{0.0, 0.3, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  for (VelocityStep& step : programme.steps) step.heading_rad = 0.0;
  Operator person(programme, test::Go2(), test::FlatGround());
  (void)person.Update({}, 0.5, 0.01);
  RobotState turned;
  turned.R_WB = core::RotationZ(0.5);
  EXPECT_LT(person.Update(turned, 0.9, 0.01).w_z_radps, -0.5);
  EXPECT_TRUE(person.Update(turned, 1.5, 0.01).IsStop());
  person.Resume({{0.0, 0.0}, 0.5});
  EXPECT_EQ(person.Update(turned, 0.9, 0.01).w_z_radps, 0.0) << "set down, it goes on from there";
}

}  // namespace
}  // namespace scoria::app
