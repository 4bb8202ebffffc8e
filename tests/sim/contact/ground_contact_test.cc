// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <gtest/gtest.h>

#include "sim/plant/plant.h"
#include "terrains/rocks.h"
#include "tests/support/robots.h"

namespace scoria::sim {
namespace {

/// A level plain with one rock in its middle, as the generator builds them.
terrains::Heightfield Rock(double diameter_m, double burial, double scale) {
  terrains::Grid heights(400, 0.025);
  terrains::Rock rock;
  rock.diameter_m = diameter_m;
  rock.height_m = 0.5 * diameter_m;
  rock.burial = burial;
  (void)terrains::AddRocks(heights, {rock});
  for (double& z : heights.values) z *= scale;
  return terrains::Heightfield(heights.nodes, heights.spacing_m, std::move(heights.values), {});
}

/// Smallest distance of the foot's centre to the surface, by brute force.
double TrueDistance(const terrains::Heightfield& ground, const Vec3& c) {
  double least = 1e9;
  constexpr double kReach_m = 0.06, kStep_m = 5e-4;
  for (double x = c.x() - kReach_m; x < c.x() + kReach_m; x += kStep_m) {
    for (double y = c.y() - kReach_m; y < c.y() + kReach_m; y += kStep_m)
      least = std::min(least, (c - Vec3(x, y, ground.HeightAt(x, y))).norm());
  }
  return least;
}

// A foot that travels level into the side of a rock is stopped before it is deeper than one step of
// travel, whatever the rock's burial: the wall is seen from level ground beside it.
TEST(GroundContact, WallBesideAFootIsSeenInTime) {
  const core::RobotDescription& robot = test::Go2();
  const double radius_m = robot.legs[Leg::kFL].foot_radius_m;
  for (const auto& [diameter_m, burial, scale] :
       {std::tuple{0.4, 0.2, 1.0}, {0.4, 0.5, 1.0}, {0.4, 0.35, 1.5}, {0.8, 0.2, 1.5}}) {
    const terrains::Heightfield ground = Rock(diameter_m, burial, scale);
    Plant plant(robot, ground, {}, Vec3::Zero());
    RobotState s = test::StandingState();
    const Vec3 p_BF = core::CalcLegKinematics(robot.legs[Leg::kFL], s.q[Leg::kFL]).p_BF;
    double first_m = 1e9;
    constexpr double kTravel_m = 1.5e-3;
    for (double x = -0.5; x < 0.0 && first_m > 1e8; x += kTravel_m) {
      s.p_WB = Vec3(x, 0.0, radius_m + 3e-3) - p_BF;
      plant.Reset(s);
      plant.Step(ZeroPerLeg());
      const double depth_m = plant.truth().penetration_m[Leg::kFL];
      const double truth_m = radius_m - TrueDistance(ground, Vec3(x, 0.0, radius_m + 3e-3));
      if (truth_m > 1e-4) {
        first_m = depth_m;
        EXPECT_NEAR(depth_m, truth_m, 5e-4) << diameter_m << " " << burial << " " << scale;
      }
    }
    EXPECT_LT(first_m, 2.0 * kTravel_m);
  }
}

}  // namespace
}  // namespace scoria::sim
