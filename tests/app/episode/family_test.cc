// SPDX-License-Identifier: BSD-3-Clause
// Robots of 2 to 90 kg made from one URDF walk by their files alone, at the Froude number of the
// Go2's speed.
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/robot/normalise.h"
#include "core/robot_files/load.h"
#include "tests/support/robot_family.h"
#include "tests/support/robots.h"
#include "tests/support/scenarios.h"
#include "tests/support/walk.h"

namespace scoria::app {
namespace {

struct Pairing {
  test::FamilyMember member;
  const char* gait;
  friend void PrintTo(const Pairing& c, std::ostream* out) {
    *out << c.member.name << " " << c.gait;
  }
};

std::vector<Pairing> Pairings() {
  std::vector<Pairing> cases;
  for (const test::FamilyMember& member : test::RobotFamily()) {
    for (const char* gait : {"ags", "sgs"}) cases.push_back({member, gait});
  }
  return cases;
}

class Family : public ::testing::TestWithParam<Pairing> {};

TEST_P(Family, WalksByItsFilesAlone) {
  const auto& [member, gait] = GetParam();
  const test::TemporaryFolder folder;
  const auto file = test::WriteFamilyRobot(member, folder.path());
  const double l = member.length_scale;
  const Scenario scenario = test::LoadScenario(
      "flat", {fmt::format("robot={{base: {}}}", file.string()),
               fmt::format("controller.gait.type={}", gait), "duration_s=20",
               fmt::format("operator.steps=[{{at_s: 0, v_x_mps: {}}}]", 0.5 * std::sqrt(l))});
  const test::WalkOutcome o = test::Walk(scenario);
  EXPECT_EQ(o.result.falls, 0);
  const core::RobotDescription robot = core::LoadRobot(scenario.robot);
  const double leg_m = core::LegLength(robot.legs[Leg::kFL]);
  constexpr double kOneDegree = std::numbers::pi / 180.0;
  EXPECT_LT(o.metrics.tracking.height_rmse_m.value(), 0.01 * leg_m);
  EXPECT_LT(o.metrics.tracking.roll_rmse_rad.value(), kOneDegree);
  EXPECT_LT(o.metrics.tracking.pitch_rmse_rad.value(), kOneDegree);
  EXPECT_NEAR(o.metrics.tracking.velocity_x_mps, 0.5 * std::sqrt(l), 0.03 * std::sqrt(l));
  EXPECT_GT(o.metrics.estimation.nees_ratio, 0.3);
  EXPECT_LT(o.metrics.estimation.nees_ratio, 2.0);
}

INSTANTIATE_TEST_SUITE_P(Every, Family, ::testing::ValuesIn(Pairings()), [](const auto& test) {
  return test.param.member.name + "_" + test.param.gait;
});

}  // namespace
}  // namespace scoria::app
