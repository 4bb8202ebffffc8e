// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <gtest/gtest.h>

#include "core/config/archive.h"
#include "core/files.h"
#include "core/math/so3.h"
#include "core/robot/kinematics.h"
#include "core/robot/normalise.h"
#include "core/robot/whole_body.h"
#include "core/robot_files/inspect.h"
#include "core/robot_files/load.h"
#include "core/robot_files/mesh.h"
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
  EXPECT_EQ(ErrorOf(urdf, "<joint name=\"FL_calf_joint\"", "<joint name=\"FL_claf_joint\""),
            "go2.urdf: legs.FL.kfe: the URDF has no joint \"FL_calf_joint\" (did you mean "
            "\"FR_calf_joint\"?)");
  EXPECT_EQ(ErrorOf(urdf, "<joint name=\"FL_calf_joint\" type=\"revolute\"",
                    "<joint name=\"FL_calf_joint\" type=\"fixed\""),
            "go2.urdf: legs.FL.kfe: \"FL_calf_joint\" must be a revolute or continuous joint");
  EXPECT_EQ(ErrorOf(urdf, "mass value=\"6.921\"", "mass value=\"-1\""),
            "go2.urdf: base_link: mass -1 must be >= 0");
  EXPECT_EQ(
      ErrorOf(urdf, "mass value=\"6.921\"", "mass value=\"nan\""),
      "go2.urdf: urdf: not a valid URDF: Inertial: mass [nan] is not a float; Could not parse "
      "inertial element for Link [base_link]");
  EXPECT_EQ(ErrorOf(urdf, "ixx=\"0.02448\"", "ixx=\"nan\""),
            "go2.urdf: urdf: not a valid URDF: Inertial: inertia element ixx is not a valid "
            "double; Could not parse inertial element for Link [base_link]");
  EXPECT_EQ(ErrorOf(urdf, "ixx=\"0.02448\"", "ixx=\"-0.02\""),
            "go2.urdf: base_link: inertia must not be negative");
  EXPECT_EQ(ErrorOf(urdf, "<sphere radius=\"0.022\"/>", "<box size=\"1 1 1\"/>"),
            "go2.urdf: legs: foot link \"FL_foot\" is missing or has no collision sphere (and the "
            "robot's YAML no foot_radius_m)");
  EXPECT_EQ(ErrorOf(urdf, "lower=\"-1.0472\" upper=\"1.0472\"", "lower=\"1\" upper=\"-1\""),
            "go2.urdf: FL_hip_joint: lower limit 1 must be below upper limit -1");
  EXPECT_EQ(ErrorOf(urdf, "<axis xyz=\"1 0 0\"/>", "<axis xyz=\"0 0 1\"/>"),
            "go2.urdf: legs: FL_hip_joint turns about (0.00 0.00 1.00) of the trunk, not about its "
            "x axis");
  EXPECT_EQ(ErrorOf(urdf, "<parent link=\"FL_hip\"/>", "<parent link=\"FR_hip\"/>"),
            "go2.urdf: FL_thigh_joint: does not follow the chain trunk, HAA, HFE, KFE");
  EXPECT_EQ(ErrorOf(urdf, "</robot>", ""),
            "go2.urdf: urdf: not a valid URDF: Error reading end tag.");
}

TEST(RobotErrors, SayWhatIsWrongWithTheNames) {
  const auto error = [](auto change) {
    RobotConfig config = test::Go2().config;
    config.urdf = "go2.urdf";
    change(config);
    try {
      (void)MakeRobot(config, test::Go2().urdf_text);
    } catch (const ConfigError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_EQ(error([](RobotConfig& c) { c.legs.fl.hfe = "FL_tigh_joint"; }),
            "go2.urdf: legs.FL.hfe: the URDF has no joint \"FL_tigh_joint\" (did you mean "
            "\"FL_thigh_joint\"?)");
  EXPECT_EQ(error([](RobotConfig& c) { c.legs.fr.foot = "FL_foot"; }),
            "go2.urdf: legs.FR.foot: \"FL_foot\" is legs.FL.foot already");
  EXPECT_EQ(error([](RobotConfig& c) { c.legs.fr.kfe = "FL_calf_joint"; }),
            "go2.urdf: legs.FR.kfe: \"FL_calf_joint\" is legs.FL.kfe already");
  EXPECT_EQ(error([](RobotConfig& c) { c.legs.fl.foot = "FL_toe"; }),
            "go2.urdf: legs.FL.foot: the URDF has no link \"FL_toe\"");
  EXPECT_EQ(error([](RobotConfig& c) { std::swap(c.legs.fl, c.legs.hl); }),
            "go2.urdf: legs: FL has its hip at x -0.193, y 0.046 of the trunk, where another leg "
            "should be");
  EXPECT_EQ(error([](RobotConfig& c) { c.imu_link = "gyro"; }),
            "go2.urdf: imu_link: the trunk has no link \"gyro\"");
}

RobotConfig ConfigOf(const std::string& path) {
  return ReadConfig<RobotConfig>(LoadConfig(test::SourcePath(path)));
}

TEST(RobotErrors, RobotWithoutTorqueIsRefusedForWalking) {
  test::TemporaryFolder folder;
  std::string urdf = test::Go2().urdf_text;
  const std::string from = "effort=\"23.7\"";
  urdf.replace(urdf.find(from), from.size(), "effort=\"0\"");
  RobotConfig config = test::Go2().config;
  config.urdf = folder.path() / "weak.urdf";
  WriteText(config.urdf, urdf);
  try {
    (void)LoadRobot(config);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_TRUE(
        std::string(e.what()).ends_with("weak.urdf: FL_hip_joint: needs a positive effort limit, "
                                        "in the URDF or as limits of the robot's YAML"))
        << e.what();
  }
}

// B12: totals of the reference digest, section 2.
TEST(B12, MassAndCentreOfMassAreTheReferences) {
  const RobotDescription robot = LoadRobot(ConfigOf("robots/b12/b12.yaml"));
  EXPECT_NEAR(robot.total_mass_kg(), 10.8475, 1e-4);
  const WholeBodyModel model(robot, 9.81);
  WholeBody wb;
  model.Calc(RobotState{}, wb);
  EXPECT_LT((wb.p_WC - Vec3(0.0001, -0.0002, -0.0133)).norm(), 1e-4);
  RobotState stand;
  stand.q = LegArray<Vec3>({0.126, 0.61, -1.22}, {-0.126, 0.61, -1.22}, {0.126, 0.61, -1.22},
                           {-0.126, 0.61, -1.22});
  model.Calc(stand, wb);
  EXPECT_LT((wb.p_WC - Vec3(-0.0054, -0.0002, -0.0079)).norm(), 1e-4);
  EXPECT_FALSE(robot.config.has_foot_sensors);
}

/// Trunk and feet of a robot are where its URDF puts them, whatever the joints are called and
/// however they turn: the same pose by the URDF's angles and by ours.
TEST(OtherRobots, JointsOfAnySignAndZeroBecomeTheHouses) {
  for (const char* name : {"mule", "kid"}) {
    const RobotDescription robot =
        LoadRobot(ConfigOf(fmt::format("tests/data/robots/{0}/{0}.yaml", name)));
    for (const Leg leg : kLegs) {
      const LegDescription& l = robot.legs[leg];
      const Vec3 straight = CalcLegKinematics(l, Vec3::Zero()).p_BF;
      const Vec3 hip = l.joints[0].p_PJ + l.joints[1].p_PJ;
      EXPECT_NEAR(straight.x(), hip.x(), 2e-3) << name;
      EXPECT_LT(straight.z(), hip.z() - 0.1) << name;
      // Positive HAA lifts the left foot outwards, positive HFE swings the foot back.
      EXPECT_GT(CalcLegKinematics(l, {0.1, 0.0, 0.0}).p_BF.y(), straight.y()) << name;
      EXPECT_LT(CalcLegKinematics(l, {0.0, 0.1, 0.0}).p_BF.x(), straight.x()) << name;
      EXPECT_LT(l.joints[2].upper_rad, 0.0) << name << ": the knee bends backwards";
    }
  }
  const RobotDescription mule = LoadRobot(ConfigOf("tests/data/robots/mule/mule.yaml"));
  EXPECT_EQ(mule.legs[Leg::kFL].joints[1].urdf_sign, -1.0);
  EXPECT_NEAR(mule.legs[Leg::kFL].joints[2].urdf_zero_rad, 1.3, 1e-6);
  EXPECT_NEAR(mule.total_mass_kg(), 29.45, 1e-6);  // with its fixed links
  const RobotDescription kid = LoadRobot(ConfigOf("tests/data/robots/kid/kid.yaml"));
  EXPECT_EQ(kid.legs[Leg::kFR].joints[0].urdf_sign, -1.0);
  EXPECT_NEAR(kid.legs[Leg::kFR].joints[0].urdf_zero_rad, 0.3, 1e-6);
  EXPECT_EQ(kid.legs[Leg::kFL].foot_radius_m, 0.014);
}

// The frames of links are the URDF's own business: with every joint axis called z, as CAD exports
// have it, the same robot has the same lengths, stance and masses.
TEST(OtherRobots, LinkFramesMayPointAnywhere) {
  RobotConfig config = test::Go2().config;
  config.nominal_height_m = config.max_leg_length_m = 0.0;
  config.stance_front_m = config.stance_hind_m = config.lying_pose_rad = Vec3::Zero();
  const RobotDescription plain = MakeRobot(config, test::Go2().urdf_text);
  RobotDescription turned = plain;
  const Mat3 R = RotationFromRpy({0.4, -0.7, 1.1});  // each link frame turned against its parent's
  for (const Leg leg : kLegs) {
    LegDescription& l = turned.legs[leg];
    Mat3 R_before = Mat3::Identity();  // of the parent's frame
    for (std::size_t j = 0; j < 3; ++j) {
      const Mat3 R_LNew = R_before * R;
      l.joints[j].p_PJ = R_before.transpose() * l.joints[j].p_PJ;
      l.joints[j].R_PJ = R_before.transpose() * R_LNew;
      l.joints[j].axis_J = R_LNew.transpose() * l.joints[j].axis_J;
      l.links[j].p_OC = R_LNew.transpose() * l.links[j].p_OC;
      l.links[j].I_C = R_LNew.transpose() * l.links[j].I_C * R_LNew;
      R_before = R_LNew;
    }
    l.p_LF = R_before.transpose() * l.p_LF;
  }
  ASSERT_EQ(NormaliseJoints(turned), "");
  DeriveDefaults(turned);
  EXPECT_NEAR(ThighLength(turned.legs[Leg::kFL]), 0.213, 1e-9);
  const WholeBodyModel a(plain, 9.81), b(turned, 9.81);
  Rng rng(5, 0, Stream::kSensor);
  for (int i = 0; i < 10; ++i) {
    const RobotState s = test::RandomState(rng);
    WholeBody wa, wb;
    a.Calc(s, wa);
    b.Calc(s, wb);
    EXPECT_LT((AssembleMassMatrix(wa) - AssembleMassMatrix(wb)).norm(), 1e-9);
    EXPECT_LT((AssembleBias(wa) - AssembleBias(wb)).norm(), 1e-8);
  }
}

TEST(OtherRobots, MeshesAreDrawnAndCollideAsTheirHull) {
  const RobotDescription mule = LoadRobot(ConfigOf("tests/data/robots/mule/mule.yaml"));
  const auto trunk = std::find_if(mule.collisions.begin(), mule.collisions.end(),
                                  [](const Shape& s) { return s.body == 0; });
  ASSERT_NE(trunk, mule.collisions.end());
  EXPECT_EQ(trunk->kind, Shape::Kind::kHull);
  EXPECT_LT((trunk->size_m - Vec3(0.62, 0.24, 0.16)).norm(), 1e-6);
  EXPECT_EQ(trunk->hull.size(), 8u) << "a box's corners";
  const auto mesh = std::find_if(mule.visuals.begin(), mule.visuals.end(),
                                 [](const Shape& s) { return s.kind == Shape::Kind::kMesh; });
  ASSERT_NE(mesh, mule.visuals.end());
  EXPECT_TRUE(LoadMesh(mesh->mesh, mesh->size_m).has_value());
}

TEST(Inspect, NamesWhatLooksWrong) {
  EXPECT_TRUE(FindSuspicions(test::Go2()).empty());
  const auto found = [](const std::string& from, const std::string& to) {
    std::string urdf = test::Go2().urdf_text;
    urdf.replace(urdf.find(from), from.size(), to);
    return fmt::format("{}", fmt::join(FindSuspicions(MakeRobot(test::Go2().config, urdf)), "; "));
  };
  EXPECT_EQ(found("effort=\"23.7\"", "effort=\"0\""),
            "FL_hip_joint: no effort limit, so the robot cannot walk; set limits of the robot's "
            "YAML; FL and FR are no mirror "
            "images: effort of HAA 0 and 23.7 Nm");
  EXPECT_EQ(found("ixx=\"0.02448\"", "ixx=\"0.002448\""),
            "base_link: principal moments 0.00245, 0.0982, 0.107 kg m^2 violate the triangle "
            "inequality");
  EXPECT_EQ(found("<mass value=\"1.152\"/>", "<mass value=\"2\"/>"),
            "FL and FR are no mirror images: mass of the HFE link 2 and 1.152 kg");
}

TEST(Inspect, NamesMassesThatNoRobotHas) {
  const auto found = [](const std::string& from, const std::string& to) {
    std::string urdf = test::Go2().urdf_text;
    urdf.replace(urdf.find(from), from.size(), to);
    return fmt::format("{}", fmt::join(FindSuspicions(MakeRobot(test::Go2().config, urdf)), "; "));
  };
  // In grams: 6921 + 8.098 kg over 0.426³ m³; √(0.107 / 6921) m; both out of what robots are.
  const std::string grams = found("mass value=\"6.921\"", "mass value=\"6921\"");
  EXPECT_NE(
      grams.find("6929 kg on legs of 0.426 m: no robot is so heavy; are masses in kg, lengths "
                 "in m?"),
      std::string::npos)
      << grams;
  const std::string narrow = found("mass value=\"6.921\"", "mass value=\"692100\"");
  EXPECT_NE(narrow.find("base_link: radius of gyration 0.00039 m for 6.92e+05 kg, of a robot of "),
            std::string::npos)
      << narrow;
  // 30 of 15.019 + 28.848 kg.
  const std::string leg = found("<mass value=\"1.152\"/>", "<mass value=\"30\"/>");
  EXPECT_NE(leg.find("30 of the robot's 43.9 kg are in one link of a leg"), std::string::npos)
      << leg;
}

TEST(Inspect, NamesLimitsThatLookLikePlaceholders) {
  RobotDescription robot = test::Go2();
  robot.legs[Leg::kFL].joints[2].effort_Nm = 1000.0;
  robot.legs[Leg::kFL].joints[0].velocity_radps = 1000.0;
  // 5 m g L = 5 x 15.019 x 9.81 x 0.426 Nm, 15 sqrt(g / L) = 72.0 rad/s.
  EXPECT_EQ(fmt::format("{}", fmt::join(FindModelWarnings(robot), "; ")),
            "FL_hip_joint: limit of 1000 rad/s looks like a placeholder, drives of such a robot "
            "stay below 72 rad/s; set limits.haa.velocity_radps in the robot's YAML; "
            "FL_calf_joint: limit of 1000 Nm looks like a placeholder, drives of such a robot stay "
            "below 314 Nm; set limits.kfe.effort_Nm in the robot's YAML");
}

TEST(Inspect, NamesWhatTheYamlGetsWrong) {
  RobotConfig config = test::Go2().config;
  config.nominal_height_m = 1.5;
  config.lying_pose_rad = {0.0, 9.0, -2.0};
  config.stance_front_m.y() = -0.15;
  const std::string found =
      fmt::format("{}", fmt::join(FindSuspicions(MakeRobot(config, test::Go2().urdf_text)), "; "));
  EXPECT_EQ(
      found,
      "nominal_height_m 1.500 is beyond thigh and shank, 0.426 m; stance_front_m and "
      "stance_hind_m are of the left legs: y must be positive; lying_pose_rad: HFE of 9.00 is "
      "outside [-1.57, 3.49]");
}

/// Meshes of every kind that the loader promises.
TEST(Mesh, ReadsObjAndColladaInMetres) {
  test::TemporaryFolder folder;
  WriteText(folder.path() / "t.obj", "v 0 0 0\nv 2 0 0\nv 0 3 0\nf 1 2 3\n");
  WriteText(folder.path() / "t.dae",
            R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema"
 version="1.4.1"><asset><unit name="millimeter" meter="0.001"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="9">0 0 0 2000 0 0
 0 3000 0</float_array><technique_common><accessor source="#a" count="3" stride="3"><param name="X"
 type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor>
</technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh>
</geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node><instance_geometry
 url="#g"/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/>
</scene></COLLADA>)");
  for (const char* name : {"t.obj", "t.dae"}) {
    const auto bounds = CalcMeshBounds(folder.path() / name, Vec3(1.0, 1.0, 1.0));
    ASSERT_TRUE(bounds.has_value()) << name;
    EXPECT_LT((bounds->high - Vec3(2.0, 3.0, 0.0)).norm(), 1e-6) << name;
  }
  EXPECT_FALSE(LoadMesh(folder.path() / "none.stl", Vec3::Ones()).has_value());
}

// The paper's robot: 16.21 kg, of which the controller knows.
TEST(Robot, EquipmentIsPartOfTheTrunk) {
  const RobotDescription bare = test::Go2();
  RobotConfig config = bare.config;
  PayloadParams kit;
  kit.name = "kit";
  kit.mass_kg = 1.19;
  kit.p_BP_m = Vec3(0.1, 0.0, 0.11);
  kit.size_m = Vec3(0.18, 0.14, 0.06);
  config.equipment = {kit};
  const RobotDescription robot = MakeRobot(config, bare.urdf_text);
  EXPECT_NEAR(robot.total_mass_kg(), bare.total_mass_kg() + 1.19, 1e-12);
  const Vec3 moment = bare.trunk.mass_kg * bare.trunk.p_OC + 1.19 * kit.p_BP_m;
  EXPECT_LT((robot.trunk.p_OC - moment / robot.trunk.mass_kg).norm(), 1e-12);
  EXPECT_EQ(robot.visuals.size(), bare.visuals.size() + 1);
  EXPECT_EQ(robot.config.nominal_height_m, bare.config.nominal_height_m);
}

}  // namespace
}  // namespace scoria::core
