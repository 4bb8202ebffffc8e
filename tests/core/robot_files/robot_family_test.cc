// SPDX-License-Identifier: BSD-3-Clause
// Robots made from one URDF: what all of them are, whatever their files look like.
#include "tests/support/robot_family.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/config/archive.h"
#include "core/math/so3.h"
#include "core/robot/kinematics.h"
#include "core/robot/normalise.h"
#include "core/robot/whole_body.h"
#include "core/robot_files/inspect.h"
#include "core/robot_files/load.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

class Family : public testing::Test {
 protected:
  RobotDescription Load(const std::string& name) const {
    for (const test::FamilyMember& member : test::RobotFamily()) {
      if (member.name == name)
        return LoadRobot(
            ReadConfig<RobotConfig>(LoadConfig(test::WriteFamilyRobot(member, folder_.path()))));
    }
    ADD_FAILURE() << name;
    return test::Go2();
  }
  const test::TemporaryFolder folder_;
};

TEST_F(Family, HasTheMassesAndLengthsAskedFor) {
  const double plain_kg = Load("plain").total_mass_kg();
  EXPECT_NEAR(plain_kg, test::Go2().total_mass_kg(), 0.01);
  for (const test::FamilyMember& member : test::RobotFamily()) {
    const RobotDescription robot = Load(member.name);
    const double arm = member.arm ? 1.1 : 1.0;
    EXPECT_NEAR(robot.total_mass_kg(), arm * member.mass_scale * plain_kg, 1e-9) << member.name;
    EXPECT_NEAR(ThighLength(robot.legs[Leg::kHL]), 0.213 * member.length_scale, 1e-9);
    EXPECT_NEAR(robot.legs[Leg::kHL].foot_radius_m, 0.022 * member.length_scale, 1e-9);
    if (member.leg_mass_share) {
      EXPECT_NEAR(1.0 - robot.trunk.mass_kg / robot.total_mass_kg(), *member.leg_mass_share, 1e-9);
    }
    EXPECT_EQ(fmt::format("{}", fmt::join(FindModelWarnings(robot), "; ")),
              member.arm ? "arm_1_joint, arm_2_joint, arm_3_joint (0.2, its limit nearest to "
                           "zero): in no leg, held at zero; the 1.5 kg beyond are part of the trunk"
                         : "");
    EXPECT_TRUE(robot.remarks.empty()) << member.name << ": " << robot.remarks.front();
  }
}

// The mass matrix of a similar robot goes with m, m l and m l².
TEST_F(Family, SimilarRobotsAreSimilar) {
  const RobotDescription plain = Load("plain"), large = Load("similar_large");
  Rng rng(5, 0, Stream::kSensor);
  RobotState s = test::RandomState(rng);
  s.v_WB.setZero();
  s.w_WB.setZero();
  s.qd = ZeroPerLeg();
  WholeBody a, b;
  WholeBodyModel(plain, 9.81).Calc(s, a);
  WholeBodyModel(large, 9.81).Calc(s, b);
  EXPECT_LT((b.I_C_W - 6.0 * 1.8 * 1.8 * a.I_C_W).norm(), 1e-9);
  EXPECT_LT((b.H_ll[Leg::kHR] - 6.0 * 1.8 * 1.8 * a.H_ll[Leg::kHR]).norm(), 1e-9);
  EXPECT_LT((b.h_l[Leg::kFL] - 6.0 * 1.8 * a.h_l[Leg::kFL]).norm(), 1e-9) << "of rest";
  EXPECT_NEAR(large.config.nominal_height_m, 1.8 * plain.config.nominal_height_m, 1e-9);
}

// Turned link frames, signs, zeros and a root elsewhere leave the same robot.
TEST_F(Family, FilesThatLookDifferentAreTheSameRobot) {
  const RobotDescription plain = Load("plain");
  for (const char* name : {"turned_frames", "root_away"}) {
    const RobotDescription robot = Load(name);
    const WholeBodyModel a(plain, 9.81), b(robot, 9.81);
    Rng rng(7, 0, Stream::kSensor);
    for (int i = 0; i < 10; ++i) {
      const RobotState s = test::RandomState(rng);
      WholeBody wa, wb;
      a.Calc(s, wa);
      b.Calc(s, wb);
      EXPECT_LT((AssembleMassMatrix(wa) - AssembleMassMatrix(wb)).norm(), 1e-8) << name;
      EXPECT_LT((AssembleBias(wa) - AssembleBias(wb)).norm(), 1e-7) << name;
    }
    for (const Leg leg : kLegs) {
      for (std::size_t j = 0; j < 3; ++j) {
        const JointDescription &p = plain.legs[leg].joints[j], &q = robot.legs[leg].joints[j];
        EXPECT_NEAR(p.lower_rad, q.lower_rad, 1e-9) << name << q.name;
        EXPECT_NEAR(p.upper_rad, q.upper_rad, 1e-9) << name << q.name;
      }
    }
  }
  const RobotDescription turned = Load("turned_frames");
  EXPECT_NEAR(turned.legs[Leg::kFL].joints[2].urdf_zero_rad, 1.1, 1e-9);
  EXPECT_NEAR(turned.legs[Leg::kFR].joints[2].urdf_zero_rad, -1.1, 1e-9);
  EXPECT_EQ(turned.legs[Leg::kFR].joints[2].urdf_sign, -1.0);
}

TEST_F(Family, MirroredHindLegsBendForwards) {
  const RobotDescription robot = Load("mirrored_hind_legs");
  EXPECT_EQ(KneeWay(robot.legs[Leg::kFL]), -1.0);
  EXPECT_EQ(KneeWay(robot.legs[Leg::kHL]), 1.0);
  EXPECT_TRUE(BendsEitherWay(robot.legs[Leg::kHL]));
}

}  // namespace
}  // namespace scoria::core
