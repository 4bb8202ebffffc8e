// SPDX-License-Identifier: BSD-3-Clause
// Which way knees bend, limits of the robot's YAML, and where the trunk's frame lies.
#include <functional>
#include <numbers>

#include <gtest/gtest.h>

#include "core/config/node.h"
#include "core/math/so3.h"
#include "core/robot/kinematics.h"
#include "core/robot/normalise.h"
#include "core/robot/trunk_frame.h"
#include "core/robot/whole_body.h"
#include "core/robot_files/load.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

/// The Go2 as its file has it, after a change of the text's every occurrence of `from`.
RobotDescription Make(
    const std::vector<std::pair<std::string, std::string>>& replacements,
    const std::function<void(RobotConfig&)>& change = [](RobotConfig&) {}) {
  std::string urdf = test::Go2().urdf_text;
  for (const auto& [from, to] : replacements) {
    EXPECT_NE(urdf.find(from), std::string::npos) << from;
    for (std::size_t at = urdf.find(from); at != std::string::npos;
         at = urdf.find(from, at + to.size()))
      urdf.replace(at, from.size(), to);
  }
  RobotConfig config = test::Go2().config;
  config.urdf = "go2.urdf";
  change(config);
  return MakeRobot(config, urdf);
}

std::string ErrorOf(const std::vector<std::pair<std::string, std::string>>& replacements,
                    const std::function<void(RobotConfig&)>& change) {
  try {
    (void)Make(replacements, change);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

const std::string kKneeLimits = "lower=\"-2.7227\" upper=\"-0.83776\"";
const std::string kFree = "lower=\"-2.7\" upper=\"2.7\"";

double Front(const RobotDescription& robot) { return KneeWay(robot.legs[Leg::kFL]); }
double Hind(const RobotDescription& robot) { return KneeWay(robot.legs[Leg::kHR]); }

TEST(Knees, BendAsTheirLimitsAllow) {
  const RobotDescription back = Make({});
  EXPECT_EQ(Front(back), -1.0);
  EXPECT_EQ(Hind(back), -1.0);
  EXPECT_FALSE(BendsEitherWay(back.legs[Leg::kFL]));
  const RobotDescription forward = Make({{kKneeLimits, "lower=\"0.83776\" upper=\"2.7227\""}});
  EXPECT_EQ(Front(forward), 1.0);
  EXPECT_EQ(Hind(forward), 1.0);
}

TEST(Knees, FreeOnesBendBackUnlessTheYamlSaysOtherwise) {
  const RobotDescription back = Make({{kKneeLimits, kFree}});
  EXPECT_EQ(Front(back), -1.0);
  EXPECT_EQ(Hind(back), -1.0);
  EXPECT_TRUE(BendsEitherWay(back.legs[Leg::kFL]));
  const RobotDescription mirrored =
      Make({{kKneeLimits, kFree}}, [](RobotConfig& c) { c.knees.hind = KneeBend::kForward; });
  EXPECT_EQ(Front(mirrored), -1.0);
  EXPECT_EQ(Hind(mirrored), 1.0);
  EXPECT_GT(LyingPose(mirrored, Leg::kHL).z(), 1.0);
  EXPECT_EQ(ErrorOf({}, [](RobotConfig& c) { c.knees.hind = KneeBend::kForward; }),
            "go2.urdf: legs: knees.hind: forward is beyond the limits [-2.723, -0.838] rad of "
            "RL_calf_joint; they leave HL less than 0.5 rad that way");
}

TEST(Knees, BendAtTheUrdfsZeroTells) {
  // The zero of the hind shanks swings them back by 0.3 rad, as a knee that bends forwards has it.
  RobotDescription robot = Make({{kKneeLimits, kFree}});
  for (const Leg leg : {Leg::kHL, Leg::kHR}) {
    JointDescription& knee = robot.legs[leg].joints[2];
    knee.R_PJ = Eigen::AngleAxisd(0.3, Vec3::UnitY()).toRotationMatrix();
  }
  ASSERT_EQ(NormaliseJoints(robot), "");
  EXPECT_NEAR(robot.legs[Leg::kHL].joints[2].urdf_zero_rad, -0.3, 0.01);
  EXPECT_EQ(Front(robot), -1.0);
  EXPECT_EQ(Hind(robot), 1.0);
}

TEST(Knees, MirroredShanksBendTheOtherWay) {
  RobotDescription robot = Make({{kKneeLimits, kFree}});
  for (const Leg leg : {Leg::kHL, Leg::kHR}) {
    Body& shank = robot.legs[leg].links[2];
    shank.p_OC.x() *= -1.0;
  }
  ASSERT_EQ(NormaliseJoints(robot), "");
  EXPECT_EQ(Front(robot), -1.0);
  EXPECT_EQ(Hind(robot), 1.0);
}

TEST(Limits, OfTheYamlReplaceTheUrdfs) {
  const auto change = [](RobotConfig& c) {
    c.limits.haa = {.lower_rad = -0.5, .upper_rad = 0.7, .effort_Nm = 11.0, .velocity_radps = {}};
    c.limits.kfe = {.lower_rad = -2.5, .upper_rad = -0.2, .effort_Nm = {}, .velocity_radps = 9.0};
    c.knees.hind = KneeBend::kForward;
  };
  const RobotDescription robot = Make({{kKneeLimits, kFree}}, change);
  const auto joint = [&](Leg leg, int j) {
    return robot.legs[leg].joints[static_cast<std::size_t>(j)];
  };
  EXPECT_EQ(joint(Leg::kFL, 0).lower_rad, -0.5);
  EXPECT_EQ(joint(Leg::kFR, 0).lower_rad, -0.7);
  EXPECT_EQ(joint(Leg::kFR, 0).upper_rad, 0.5);
  EXPECT_EQ(joint(Leg::kHR, 0).effort_Nm, 11.0);
  EXPECT_EQ(joint(Leg::kHR, 0).velocity_radps, 30.1);
  EXPECT_EQ(joint(Leg::kFL, 2).upper_rad, -0.2);
  EXPECT_EQ(joint(Leg::kHL, 2).lower_rad, 0.2) << "its knee bends forwards";
  EXPECT_EQ(joint(Leg::kHL, 2).upper_rad, 2.5);
  EXPECT_EQ(joint(Leg::kHL, 2).velocity_radps, 9.0);
  EXPECT_EQ(ErrorOf({}, [](RobotConfig& c) { c.limits.hfe.lower_rad = 4.0; }),
            "go2.urdf: legs: limits: FL_thigh_joint would have [4.000, 3.491] rad");
}

TEST(Limits, ContinuousJointsTurnHalfwayRoundOrAsTheYamlSays) {
  const std::vector<std::pair<std::string, std::string>> continuous = {
      {"type=\"revolute\"", "type=\"continuous\""}};
  const RobotDescription robot = Make(continuous);
  for (const Leg leg : kLegs) {
    for (const JointDescription& joint : robot.legs[leg].joints) {
      EXPECT_EQ(joint.lower_rad, -std::numbers::pi) << joint.name;
      EXPECT_EQ(joint.upper_rad, std::numbers::pi) << joint.name;
      EXPECT_GT(joint.effort_Nm, 20.0) << joint.name;
    }
  }
  EXPECT_EQ(Hind(robot), -1.0);
  const RobotDescription limited = Make(continuous, [](RobotConfig& c) {
    c.limits.kfe = {.lower_rad = 0.2, .upper_rad = 2.6, .effort_Nm = {}, .velocity_radps = {}};
  });
  EXPECT_EQ(Front(limited), 1.0);
  EXPECT_EQ(limited.legs[Leg::kHL].joints[2].lower_rad, 0.2);
}

/// As if the trunk's link had its frame elsewhere: at N, turned by R_BN.
RobotDescription WithTrunkFrame(const Mat3& R_BN, const Vec3& p_BN) {
  RobotDescription robot = test::Go2();
  const Mat3 R = R_BN.transpose();
  static_cast<SpatialInertia&>(robot.trunk) =
      Transform(R, -(R * p_BN), static_cast<const SpatialInertia&>(robot.trunk));
  for (LegDescription& leg : robot.legs) {
    leg.joints[0].p_PJ = R * (leg.joints[0].p_PJ - p_BN);
    leg.joints[0].R_PJ = R * leg.joints[0].R_PJ;
  }
  for (Shape& shape : robot.collisions) {
    if (shape.body != 0) continue;
    shape.p_LG = R * (shape.p_LG - p_BN);
    shape.R_LG = R * shape.R_LG;
  }
  robot.p_BS = R * (robot.p_BS - p_BN);
  robot.R_BS = R * robot.R_BS;
  return robot;
}

TEST(TrunkFrame, IsPutAmidstTheHips) {
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  const RobotDescription& go2 = test::Go2();
  for (const Vec3& rpy_rad : {Vec3(0, 0, 0), Vec3(0, 0, kQuarter), Vec3(kQuarter, 0, kQuarter),
                              Vec3(0, 0, 2.0 * kQuarter)}) {
    RobotDescription robot = WithTrunkFrame(RotationFromRpy(rpy_rad), Vec3(0.3, -0.1, 0.2));
    PlaceTrunkFrame(robot);
    ASSERT_EQ(NormaliseJoints(robot), "") << rpy_rad.transpose();
    EXPECT_LT((robot.trunk.p_OC - go2.trunk.p_OC).norm(), 1e-12);
    EXPECT_LT((robot.trunk.I_C - go2.trunk.I_C).norm(), 1e-12);
    EXPECT_LT((robot.p_BS - go2.p_BS).norm(), 1e-12);
    EXPECT_TRUE(robot.R_BS.isApprox(go2.R_BS));
    EXPECT_LT((robot.collisions[0].p_LG - go2.collisions[0].p_LG).norm(), 1e-12);
    const Vec3 q(0.1, 0.8, -1.6);
    EXPECT_LT((CalcLegKinematics(robot.legs[Leg::kHR], q).p_BF -
               CalcLegKinematics(go2.legs[Leg::kHR], q).p_BF)
                  .norm(),
              1e-12);
    ASSERT_EQ(robot.remarks.size(), 1u);
  }
  RobotDescription robot = WithTrunkFrame(RotationFromRpy({0, 0, kQuarter}), Vec3(0.3, 0, 0));
  PlaceTrunkFrame(robot);
  EXPECT_EQ(robot.remarks.at(0),
            "base_link: the trunk's frame is put at (0 0.3 0) m of it, turned by roll, "
            "pitch and yaw of (0 0 -1.571) rad: amidst the hips, x forwards, z up");
}

TEST(TrunkFrame, StaysWhereTheUrdfHasItNearTheHips) {
  RobotDescription robot = WithTrunkFrame(Mat3::Identity(), Vec3(0.02, 0.0, 0.06));
  const RobotDescription before = robot;
  PlaceTrunkFrame(robot);
  EXPECT_EQ(robot.trunk.p_OC, before.trunk.p_OC);
  EXPECT_TRUE(robot.remarks.empty());
}

}  // namespace
}  // namespace scoria::core
