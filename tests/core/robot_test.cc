// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "core/robot/kinematics.h"
#include "core/robot/whole_body.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

std::string ErrorOf(std::string urdf, const std::string& from, const std::string& to) {
  const std::size_t at = urdf.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  urdf.replace(at, from.size(), to);
  RobotConfig config = test::Go2().config;
  config.urdf = "go2.urdf";
  try {
    (void)MakeRobot(config, urdf);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

// Totals of the reference digest: 15.019 kg; COM at the zero pose.
TEST(Go2, MassAndCentreOfMassAreTheReferences) {
  const RobotDescription& robot = test::Go2();
  EXPECT_NEAR(robot.total_mass_kg(), 15.019, 1e-9);
  const core::WholeBodyModel model(robot, 9.81);
  core::WholeBody wb;
  model.Calc(RobotState{}, wb);
  EXPECT_NEAR(wb.p_WC.x(), 0.00884, 5e-5);
  EXPECT_NEAR(wb.p_WC.y(), 0.0, 5e-5);
  EXPECT_NEAR(wb.p_WC.z(), -0.0305, 5e-5);
  EXPECT_NEAR(wb.I_C_W(0, 0), 0.22845, 5e-4);
  EXPECT_NEAR(wb.I_C_W(1, 1), 0.51511, 5e-4);
  EXPECT_NEAR(wb.I_C_W(2, 2), 0.50095, 5e-4);
}

TEST(Go2, FeetStandWhereThePresetPoseSays) {
  const RobotDescription& robot = test::Go2();
  const Vec3 q(0.0, 0.774, -1.56);
  const Vec3 p_BF = core::CalcLegKinematics(robot.legs[Leg::kFL], q).p_BF;
  EXPECT_NEAR(p_BF.y(), 0.0465 + 0.0955, 1e-9);
  EXPECT_NEAR(p_BF.z(), -0.303, 2e-3);
  EXPECT_EQ(robot.legs[Leg::kFL].foot_radius_m, 0.022);
}

TEST(Kinematics, LinkPosesAgreeWithTheWholeBodyModel) {
  Rng rng(4, 0, Stream::kSensor);
  const RobotDescription& robot = test::Go2();
  const core::WholeBodyModel model(robot, 9.81);
  for (int i = 0; i < 20; ++i) {
    const RobotState s = test::RandomState(rng);
    core::WholeBody wb;
    model.Calc(s, wb);
    const auto poses = CalcLinkPoses(robot, s.p_WB, s.R_WB, s.q);
    for (const Leg leg : kLegs) {
      const LinkPose& shank = poses[static_cast<std::size_t>(BodyIndex(leg, Joint::kKFE))];
      EXPECT_LT((shank.p_WL + shank.R_WL * robot.legs[leg].p_LF - wb.p_WF[leg]).norm(), 1e-12);
    }
  }
}

TEST(RobotErrors, SayWhatIsWrongWithAUrdf) {
  const std::string& urdf = test::Go2().urdf_text;
  EXPECT_EQ(ErrorOf(urdf, "<joint name=\"FL_calf_joint\"", "<joint name=\"FL_knee\""),
            "go2.urdf: FL_knee: is a movable joint that no leg names; it must be fixed or revolute "
            "in a leg");
  EXPECT_EQ(ErrorOf(urdf, "mass value=\"6.921\"", "mass value=\"-1\""),
            "go2.urdf: base_link: mass -1 must be >= 0");
  EXPECT_EQ(ErrorOf(urdf, "<sphere radius=\"0.022\"/>", "<box size=\"1 1 1\"/>"),
            "go2.urdf: legs: foot link \"FL_foot\" is missing or has no collision sphere");
  EXPECT_EQ(ErrorOf(urdf, "effort=\"23.7\"", "effort=\"0\""),
            "go2.urdf: FL_hip_joint: needs a limit element with a positive effort");
}

}  // namespace
}  // namespace scoria::core
