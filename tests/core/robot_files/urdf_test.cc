// SPDX-License-Identifier: BSD-3-Clause
// URDFs as others write them: what is taken, held, warned of, refused with the way out.
#include <gtest/gtest.h>

#include "core/config/archive.h"
#include "core/files.h"
#include "core/robot/normalise.h"
#include "core/robot_files/inspect.h"
#include "core/robot_files/load.h"
#include "core/robot_files/mesh.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

using Replacements = std::vector<std::pair<std::string, std::string>>;

/// The Go2's URDF with pieces replaced, each where it stands first.
std::string Go2With(const Replacements& replacements) {
  std::string urdf = test::Go2().urdf_text;
  for (const auto& [from, to] : replacements) {
    const std::size_t at = urdf.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    urdf.replace(at, from.size(), to);
  }
  return urdf;
}

RobotConfig Go2Config() {
  RobotConfig config = test::Go2().config;
  config.urdf = "go2.urdf";
  return config;
}

RobotDescription Make(const Replacements& replacements) {
  return MakeRobot(Go2Config(), Go2With(replacements));
}

std::string TextError(const std::string& urdf) {
  try {
    (void)MakeRobot(Go2Config(), urdf);
  } catch (const ConfigError& e) {
    return e.what();
  }
  return "no error";
}

std::string ErrorOf(const Replacements& replacements) { return TextError(Go2With(replacements)); }

std::string ModelWarnings(const RobotDescription& robot) {
  return fmt::format("{}", fmt::join(FindModelWarnings(robot), "; "));
}

TEST(Urdf, FilesOfAnotherKindAreNamed) {
  EXPECT_EQ(ErrorOf({{"mass value=\"6.921\"", "mass value=\"${m}\""}}),
            "go2.urdf: urdf: is a xacro, not a URDF (expand it: xacro IN > OUT.urdf)");
  EXPECT_EQ(TextError("<mujoco model=\"a\"/>"),
            "go2.urdf: urdf: is a MuJoCo model, not a URDF (a robot is a URDF)");
  EXPECT_EQ(TextError("\x89PNG\r\n\x1a\n"),
            "go2.urdf: urdf: is a PNG image, not a URDF (a terrain names it: heightmap: {file: "
            "NAME.png})");
  RobotConfig config = Go2Config();
  config.urdf = test::SourcePath("robots");
  try {
    (void)ReadRobot(config);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_EQ(e.what(), config.urdf.string() + ": urdf: is a folder, not a URDF");
  }
  config = Go2Config();
  config.legs.fl.foot = std::string(100000, 'x');
  try {
    (void)MakeRobot(config, test::Go2().urdf_text);
    FAIL();
  } catch (const ConfigError& e) {
    EXPECT_LT(std::string(e.what()).size(), 600u);
  }
  EXPECT_LT(TextError("name: go2\n" + std::string(100000, 'x')).size(), 400u);
}

TEST(Urdf, OnlyCommentsMayBeOtherThanUtf8) {
  EXPECT_EQ(ErrorOf({{"<link name=\"Head_upper\">", "<link name=\"K\xf6pf\">"}}),
            "go2.urdf:30:16: name: byte 0xF6 is not UTF-8; save the file as UTF-8");
  EXPECT_EQ(ErrorOf({{"Unitree Go2", "f\xfcr Go2"}}), "no error");
}

const std::string kTrunk = "<link name=\"base_link\">";

/// A bare link above the trunk, and the joint to it.
std::string Above(const std::string& name, const std::string& child, const std::string& type) {
  return fmt::format(
      "<link name=\"{0}\"/><joint name=\"{0}_joint\" type=\"{2}\"><parent link=\"{0}\"/><child "
      "link=\"{1}\"/><origin xyz=\"0 0 0.5\"/><axis xyz=\"0 0 1\"/><limit lower=\"-1\" upper=\"1\" "
      "effort=\"1\" velocity=\"1\"/></joint>",
      name, child, type);
}

TEST(Urdf, JointsThatPlaceTheRobotInTheWorldAreLeftOut) {
  for (const char* type : {"floating", "planar", "prismatic", "continuous", "revolute"}) {
    const RobotDescription robot = Make({{kTrunk, Above("world", "base_link", type) + kTrunk}});
    EXPECT_EQ(robot.trunk.name, "base_link") << type;
    EXPECT_EQ(robot.trunk.p_OC, test::Go2().trunk.p_OC) << type;
    EXPECT_EQ(ModelWarnings(robot), "") << type;
  }
  const RobotDescription chain =
      Make({{kTrunk, Above("world", "rail", "fixed") + Above("rail", "slide", "prismatic") +
                         Above("slide", "base_link", "floating") + kTrunk}});
  EXPECT_EQ(chain.trunk.name, "base_link");
  EXPECT_EQ(ModelWarnings(chain), "");
}

TEST(Urdf, TrunkIsTheLinkThatTheHipsHangFrom) {
  const RobotDescription footprint =
      Make({{kTrunk, Above("base_footprint", "base_link", "fixed") + kTrunk}});
  EXPECT_EQ(footprint.trunk.name, "base_link");
  EXPECT_EQ(footprint.trunk.p_OC, test::Go2().trunk.p_OC);
  EXPECT_EQ(footprint.legs[Leg::kHR].joints[0].p_PJ, test::Go2().legs[Leg::kHR].joints[0].p_PJ);
  EXPECT_EQ(ModelWarnings(footprint), "");
}

/// A link with mass above the trunk, which hangs from it 0.4 m behind.
std::string Neck(const std::string& type) {
  return fmt::format(
      "<link name=\"neck\"><inertial><mass value=\"2\"/><inertia ixx=\"0.01\" ixy=\"0\" ixz=\"0\" "
      "iyy=\"0.01\" iyz=\"0\" izz=\"0.01\"/></inertial></link><joint name=\"n\" "
      "type=\"{}\"><parent "
      "link=\"neck\"/><child link=\"base_link\"/><origin xyz=\"-0.4 0 0\"/><axis xyz=\"0 0 1\"/>"
      "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>",
      type);
}

TEST(Urdf, LinksAboveTheTrunkBelongToIt) {
  const SpatialInertia& plain = test::Go2().trunk;
  for (const char* type : {"fixed", "revolute", "prismatic"}) {
    const RobotDescription robot = Make({{kTrunk, Neck(type) + kTrunk}});
    EXPECT_EQ(robot.trunk.name, "base_link") << type;
    EXPECT_NEAR(robot.trunk.mass_kg, plain.mass_kg + 2.0, 1e-12) << type;
    const Vec3 moment = plain.mass_kg * plain.p_OC + 2.0 * Vec3(0.4, 0.0, 0.0);
    EXPECT_LT((robot.trunk.p_OC - moment / robot.trunk.mass_kg).norm(), 1e-12) << type;
    EXPECT_EQ(ModelWarnings(robot),
              std::string(type) == "fixed"
                  ? ""
                  : "n: in no leg, held at zero; the 2 kg beyond are part of the trunk")
        << type;
  }
  const RobotDescription apart = Make({{kTrunk, Neck("floating") + kTrunk}});
  EXPECT_EQ(apart.trunk.mass_kg, plain.mass_kg) << "what the robot floats over is not the robot";
}

/// The IMU's joint as one that moves.
Replacements ImuJoint(const std::string& type, const std::string& limit) {
  return {{"<joint name=\"imu_joint\" type=\"fixed\">",
           fmt::format("<joint name=\"imu_joint\" type=\"{}\">{}", type, limit)}};
}

TEST(Urdf, JointsOutsideOfTheLegsAreHeldAtZero) {
  const std::string limit = "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>";
  for (const auto& [type, limits] : {std::pair<std::string, std::string>{"continuous", ""},
                                     {"revolute", limit},
                                     {"prismatic", limit}}) {
    const RobotDescription robot = Make(ImuJoint(type, limits));
    EXPECT_EQ(robot.p_BS, test::Go2().p_BS) << type;
    EXPECT_EQ(ModelWarnings(robot),
              "imu_joint: in no leg, held at zero; the 0 kg beyond are part of the trunk")
        << type;
  }
  const RobotDescription limited =
      Make(ImuJoint("prismatic", "<limit lower=\"0.5\" upper=\"1\" effort=\"1\" velocity=\"1\"/>"));
  EXPECT_LT((limited.p_BS - test::Go2().p_BS - Vec3(0.5, 0.0, 0.0)).norm(), 1e-12);
  EXPECT_EQ(ModelWarnings(limited),
            "imu_joint (0.5, its limit nearest to zero): in no leg, held at zero; the 0 kg beyond "
            "are part of the trunk");
  EXPECT_EQ(ErrorOf(ImuJoint("floating", "")),
            "go2.urdf: imu_joint: floats below the trunk; only above it may a joint do so. Make it "
            "fixed");
  EXPECT_EQ(ErrorOf({{"<joint name=\"FL_foot_joint\" type=\"fixed\">",
                      "<joint name=\"FL_foot_joint\" type=\"continuous\">"}}),
            "go2.urdf: FL_foot_joint: moves below FL_calf_joint, but no leg names it; a leg has "
            "three joints. Make it fixed");
}

TEST(Urdf, DynamicsAreMentionedUnlessTheYamlHasThem) {
  std::string urdf = test::Go2().urdf_text;
  const std::string end = "</joint>", add = "<dynamics damping=\"5\" friction=\"3\"/></joint>";
  for (std::size_t at = urdf.find(end); at != std::string::npos;
       at = urdf.find(end, at + add.size()))
    urdf.replace(at, end.size(), add);
  RobotConfig config = Go2Config();
  EXPECT_EQ(
      ModelWarnings(MakeRobot(config, urdf)),
      "<dynamics> of the URDF is not used, motors of the robot's YAML are; as the URDF has it: "
      "damping_Nms_per_rad: [5, 5, 5], friction_Nm: [3, 3, 3]");
  config.motors.damping_Nms_per_rad = Vec3::Constant(5.0);
  config.motors.friction_Nm = Vec3::Constant(3.0);
  EXPECT_EQ(ModelWarnings(MakeRobot(config, urdf)), "");
}

TEST(Urdf, ShapesOutOfProportionAreWarnedOf) {
  EXPECT_EQ(
      ModelWarnings(Make({{"box size=\"0.3762 0.0935 0.114\"", "box size=\"3.762 0.935 0.114\""}})),
      "base_link: collides as a shape of 3.762 m, beside legs of 0.43 m");
  const test::TemporaryFolder folder;
  const std::string box = "<box size=\"0.3762 0.0935 0.114\"/>";
  const auto mesh = [&](const std::string& name, double size, const std::string& scale) {
    WriteText(folder.path() / name,
              fmt::format("v 0 0 0\nv {0} 0 0\nv 0 {0} {0}\nf 1 2 3\n", size));
    const std::string file = (folder.path() / name).string();
    return ModelWarnings(Make({{box, fmt::format("<mesh filename=\"{}\" {}/>", file, scale)}}));
  };
  EXPECT_EQ(mesh("mm.obj", 400.0, "scale=\"0.001 0.001 0.001\""), "");
  EXPECT_EQ(mesh("m.obj", 0.4, ""), "");
  EXPECT_EQ(mesh("m.obj", 0.4, "scale=\"0.001 0.001 0.001\""),
            "base_link: collides as m.obj of 0.0004 m, beside legs of 0.43 m; a mesh in "
            "millimetres needs scale=\"0.001 0.001 0.001\", one in metres none");
}

TEST(Urdf, VisualMeshInMillimetresIsASuspicion) {
  const test::TemporaryFolder folder;
  WriteText(folder.path() / "mm.obj", "v 0 0 0\nv 400 0 0\nv 0 90 90\nf 1 2 3\n");
  const std::string file = (folder.path() / "mm.obj").string();
  EXPECT_EQ(
      fmt::format("{}",
                  fmt::join(FindSuspicions(Make({{"<box size=\"0.34 0.15 0.1\"/>",
                                                  fmt::format("<mesh filename=\"{}\"/>", file)}})),
                            "; ")),
      fmt::format("visual mesh {} is 400 m wide, beside legs of 0.43 m; a mesh in millimetres "
                  "needs scale=\"0.001 0.001 0.001\", one in metres none",
                  file));
}

TEST(Mesh, IsFoundByEveryKindOfName) {
  const test::TemporaryFolder folder;
  const std::filesystem::path package = folder.path() / "my_dog";
  const std::filesystem::path urdf = package / "urdf" / "dog.urdf";
  std::filesystem::create_directories(package / "urdf");
  std::filesystem::create_directories(package / "mesh files");
  const std::filesystem::path spaced = package / "mesh files" / "a b.stl",
                              escaped = package / "mesh files" / "c%20d.stl";
  WriteText(spaced, "x");
  WriteText(escaped, "x");
  for (const std::string& name :
       {std::string("../mesh files/a b.stl"), std::string("../mesh%20files/a%20b.stl"),
        std::string("package://my_dog/mesh%20files/a b.stl"),
        std::string("package://other_name/mesh files/a%20b.stl"),
        std::string("model://my_dog/mesh%20files/a%20b.stl"),
        "file://" + package.string() + "/mesh%20files/a%20b.stl",
        "file://localhost" + package.string() + "/mesh%20files/a%20b.stl",
        "file:" + package.string() + "/mesh files/a b.stl",
        std::string("file://../mesh files/a b.stl")}) {
    EXPECT_TRUE(std::filesystem::equivalent(FindMesh(name, urdf), spaced)) << name;
  }
  EXPECT_TRUE(std::filesystem::equivalent(FindMesh("../mesh files/c%20d.stl", urdf), escaped));
  for (const char* name : {"package://", "model://", "file:", "%", "%2", "%zz", ""})
    EXPECT_NO_THROW((void)FindMesh(name, urdf)) << name;
}

}  // namespace
}  // namespace scoria::core
