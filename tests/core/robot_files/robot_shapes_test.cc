// SPDX-License-Identifier: BSD-3-Clause
// What a robot collides as and looks like: hulls of meshes, lost and oversized ones, shapes near
// the ground.
#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/config/node.h"
#include "core/files.h"
#include "core/rng.h"
#include "core/robot_files/convex_hull.h"
#include "core/robot_files/inspect.h"
#include "core/robot_files/load.h"
#include "core/robot_files/mesh.h"
#include "core/robot_files/mesh_records.h"
#include "tests/support/robots.h"

namespace scoria::core {
namespace {

double Support(const std::vector<Vec3>& points, const Vec3& direction) {
  double most = -1e9;
  for (const Vec3& p : points) most = std::max(most, direction.dot(p));
  return most;
}

TEST(ConvexHull, FewPointsSpanNearlyAll) {
  Rng rng(3, 0, Stream::kSensor);
  std::vector<Vec3> ball;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p(rng.NextUniform(-1.0, 1.0), rng.NextUniform(-1.0, 1.0),
                 rng.NextUniform(-1.0, 1.0));
    if (p.norm() < 1.0) ball.push_back(p);
  }
  const std::vector<Vec3> hull = ReduceToHull(ball);
  EXPECT_LE(hull.size(), kMaxHullPoints);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(Support(hull, Vec3::Unit(axis)), Support(ball, Vec3::Unit(axis)));
    EXPECT_EQ(Support(hull, -Vec3::Unit(axis)), Support(ball, -Vec3::Unit(axis)));
  }
  for (int i = 0; i < 200; ++i) {
    const Vec3 d =
        Vec3(rng.NextUniform(-1.0, 1.0), rng.NextUniform(-1.0, 1.0), rng.NextUniform(-1.0, 1.0))
            .normalized();
    EXPECT_GT(Support(hull, d), 0.8) << "a direction of the 32 lies within 0.6 rad";
    EXPECT_LE(Support(hull, d), 1.0);
  }
  EXPECT_EQ(ReduceToHull(ball), hull);
}

TEST(ConvexHull, CutEndsAtThePlane) {
  std::vector<Vec3> cube;
  for (int i = 0; i < 8; ++i) cube.emplace_back(i & 1, (i >> 1) & 1, i >> 2);
  const Vec3 down = -Vec3::UnitZ();
  const std::vector<Vec3> upper = CutHull(cube, down, -0.25);
  EXPECT_EQ(Support(upper, down), -0.25);
  EXPECT_EQ(Support(upper, -down), 1.0);
  for (const Vec3& side : {Vec3(1, 1, 0), Vec3(-1, 0, 0)})
    EXPECT_EQ(Support(upper, side), Support(cube, side));
  EXPECT_EQ(CutHull(cube, down, 0.5), cube);
  EXPECT_TRUE(CutHull(cube, down, -1.5).empty());
}

/// The Go2 with pieces of its URDF replaced, beside files of its own.
class Shapes : public testing::Test {
 protected:
  /// A wedge: a box without the edge at its upper front.
  void WriteMesh(const std::string& name, const Vec3& low, const Vec3& high) {
    std::string text;
    for (const double y : {low.y(), high.y()}) {
      for (const auto& [x, z] :
           {std::pair{low.x(), low.z()}, {high.x(), low.z()}, {low.x(), high.z()}}) {
        text += fmt::format("v {} {} {}\n", x, y, z);
      }
    }
    WriteText(folder_.path() / name,
              text + "f 1 2 3\nf 4 6 5\nf 1 4 5\nf 1 5 2\nf 2 5 6\nf 2 6 3\nf 3 6 4\nf 3 4 1\n");
  }
  [[nodiscard]] std::string File(const std::string& name) const {
    return (folder_.path() / name).string();
  }
  [[nodiscard]] std::string Mesh(const std::string& name, const std::string& scale = "") const {
    return fmt::format("<mesh filename=\"{}\" {}/>", File(name), scale);
  }
  static RobotDescription Make(const std::vector<std::pair<std::string, std::string>>& replacements,
                               const MeshRecords& meshes = {}) {
    std::string urdf = test::Go2().urdf_text;
    for (const auto& [from, to] : replacements) {
      const std::size_t at = urdf.find(from);
      EXPECT_NE(at, std::string::npos) << from;
      urdf.replace(at, from.size(), to);
    }
    RobotConfig config = test::Go2().config;
    config.urdf = "go2.urdf";
    return MakeRobot(config, urdf, meshes);
  }
  static std::string ErrorOf(const std::vector<std::pair<std::string, std::string>>& replacements) {
    try {
      (void)Make(replacements);
    } catch (const ConfigError& e) {
      return e.what();
    }
    return "no error";
  }
  static std::string WarningsOf(const RobotDescription& robot) {
    return fmt::format("{}", fmt::join(FindModelWarnings(robot), "; "));
  }
  /// Shapes of a link.
  static std::vector<Shape> Of(const std::vector<Shape>& all, const std::string& link) {
    std::vector<Shape> out;
    std::copy_if(all.begin(), all.end(), std::back_inserter(out),
                 [&](const Shape& s) { return s.link == link; });
    return out;
  }

  const std::string trunk_ = "<box size=\"0.3762 0.0935 0.114\"/>";
  const std::string trunk_visual_ = "<box size=\"0.34 0.15 0.1\"/>";
  const std::string calf_ = "<cylinder radius=\"0.012\" length=\"0.12\"/>";
  const std::string calf_place_ = "<origin xyz=\"0.008 0 -0.06\" rpy=\"0 -0.2 0\"/>";
  const test::TemporaryFolder folder_;
};

TEST_F(Shapes, MeshCollidesAsItsConvexHull) {
  WriteMesh("wedge.obj", {-200, -50, -40}, {200, 50, 60});
  const RobotDescription robot = Make({{trunk_, Mesh("wedge.obj", "scale=\"0.001 0.001 0.001\"")}});
  const std::vector<Shape> trunk = Of(robot.collisions, "base_link");
  ASSERT_EQ(trunk.size(), 1u);
  EXPECT_EQ(trunk[0].kind, Shape::Kind::kHull);
  EXPECT_EQ(trunk[0].hull.size(), 6u) << "a wedge, no box";
  EXPECT_LT((trunk[0].size_m - Vec3(0.4, 0.1, 0.1)).norm(), 1e-7);
  EXPECT_LT((trunk[0].p_LG - Vec3(0.0, 0.0, 0.01)).norm(), 1e-7);
  EXPECT_EQ(WarningsOf(robot), "");
}

TEST_F(Shapes, MirroredScaleMirrorsTheHull) {
  WriteMesh("wedge.obj", {0.0, -0.05, -0.04}, {0.2, 0.05, 0.06});
  const RobotDescription robot = Make({{trunk_, Mesh("wedge.obj", "scale=\"-1 1 1\"")}});
  const Shape trunk = Of(robot.collisions, "base_link").at(0);
  EXPECT_LT((trunk.p_LG - Vec3(-0.1, 0.0, 0.01)).norm(), 1e-7);
  EXPECT_NEAR(Support(trunk.hull, Vec3(-1.0, 0.0, 1.0)), 0.05, 1e-7)
      << "the lower front corner alone: the upper one is cut away";
}

TEST_F(Shapes, RecordOfALogStandsForTheFile) {
  WriteMesh("wedge.obj", {-0.2, -0.05, -0.04}, {0.2, 0.05, 0.06});
  const std::vector<std::pair<std::string, std::string>> mesh = {{trunk_, Mesh("wedge.obj")}};
  const RobotDescription robot = Make(mesh);
  MeshRecords records = RecordMeshes(robot);
  std::filesystem::remove(File("wedge.obj"));
  const RobotDescription again = Make(mesh, records);
  EXPECT_EQ(Of(again.collisions, "base_link").at(0).hull,
            Of(robot.collisions, "base_link").at(0).hull);
  for (auto& [name, record] : records) record.hull.clear();
  const Shape box = Of(Make(mesh, records).collisions, "base_link").at(0);
  EXPECT_EQ(box.kind, Shape::Kind::kBox) << "as the version that recorded it had it";
  EXPECT_LT((box.size_m - Vec3(0.4, 0.1, 0.1)).norm(), 1e-7);
}

TEST_F(Shapes, LostCollisionMeshTakesTheVisualsShape) {
  const std::string gone = "base_link: collision mesh /gone/a.stl cannot be read; the link ";
  const std::string lost = "<mesh filename=\"/gone/a.stl\"/>";
  const RobotDescription boxes = Make({{trunk_, lost}});
  EXPECT_EQ(WarningsOf(boxes),
            gone + "collides as the box that it looks like, the box that it looks like");
  EXPECT_EQ(Of(boxes.collisions, "base_link").at(0).size_m, Vec3(0.34, 0.15, 0.1));

  WriteMesh("wedge.obj", {-0.2, -0.05, -0.04}, {0.2, 0.05, 0.06});
  const RobotDescription mesh = Make({{trunk_, lost}, {trunk_visual_, Mesh("wedge.obj")}});
  EXPECT_EQ(WarningsOf(mesh),
            gone + "collides as the box around wedge.obj, the box that it looks like");
  const Shape box = Of(mesh.collisions, "base_link").at(0);
  EXPECT_EQ(box.kind, Shape::Kind::kBox);
  EXPECT_LT((box.size_m - Vec3(0.4, 0.1, 0.1)).norm(), 1e-7);

  const RobotDescription bare =
      Make({{trunk_, lost},
            {trunk_visual_, "<mesh filename=\"/gone/b.stl\"/>"},
            {"<box size=\"0.3 0.1 0.03\"/>", "<mesh filename=\"/gone/b.stl\"/>"}});
  EXPECT_EQ(WarningsOf(bare), gone + "does not collide");
  EXPECT_TRUE(Of(bare.collisions, "base_link").empty());
}

TEST_F(Shapes, OversizedShapeIsRefused) {
  WriteMesh("mm.obj", {-200, -50, -40}, {200, 50, 60});
  EXPECT_EQ(
      ErrorOf({{trunk_, Mesh("mm.obj")}}),
      fmt::format("go2.urdf: base_link: collides as {} of 400 m; a robot with 0.82 m from "
                  "hip to hip and down to the foot may have shapes of up to 8.24 m; a mesh in "
                  "millimetres needs scale=\"0.001 0.001 0.001\", one in metres none",
                  File("mm.obj")));
  EXPECT_EQ(ErrorOf({{trunk_, "<box size=\"9 0.1 0.1\"/>"}}),
            "go2.urdf: base_link: collides as a shape of 9 m; a robot with 0.82 m from hip to hip "
            "and down to the foot may have shapes of up to 8.24 m");
  EXPECT_EQ(ErrorOf({{trunk_, "<box size=\"8 0.1 0.1\"/>"}}), "no error");
}

TEST_F(Shapes, NothingOfALegComesLowerThanItsFoot) {
  // As low as the foot's sphere where the leg is straight; lower where the shank is tilted.
  const RobotDescription robot = Make(
      {{calf_place_, "<origin xyz=\"0 0 -0.12\"/>"}, {calf_, "<box size=\"0.06 0.05 0.23\"/>"}});
  EXPECT_EQ(WarningsOf(robot),
            "FL_calf: its collision shape comes within half a foot's radius of the ground, 28 mm "
            "too low in standing or swing poses; what is too low is cut off");
  const Shape shin = Of(robot.collisions, "FL_calf").at(0);
  EXPECT_EQ(shin.kind, Shape::Kind::kHull);
  EXPECT_GT(shin.size_m.z(), 0.17) << "most of it is left";
  const Vec3& foot = robot.legs[Leg::kFL].p_LF;
  const double radius_m = robot.legs[Leg::kFL].foot_radius_m;
  for (const double tilt_rad : {-0.6, -0.9}) {  // of the shank while the robot stands
    const Vec3 down(std::sin(tilt_rad), 0.0, -std::cos(tilt_rad));
    EXPECT_LT(Support(shin.hull, shin.R_LG.transpose() * down) + down.dot(shin.p_LG),
              down.dot(foot) + 0.8 * radius_m)
        << tilt_rad;
  }
  for (const char* link : {"FR_calf", "RL_calf"})
    EXPECT_EQ(Of(robot.collisions, link).at(0).kind, Shape::Kind::kCylinder);
}

TEST_F(Shapes, ShapeThatIsAllTooLowIsLeftOut) {
  const RobotDescription robot =
      Make({{calf_place_, "<origin xyz=\"0.02 0 -0.26\"/>"}, {calf_, "<sphere radius=\"0.02\"/>"}});
  EXPECT_TRUE(Of(robot.collisions, "FL_calf").empty());
  EXPECT_NE(WarningsOf(robot).find("; it is left out"), std::string::npos) << WarningsOf(robot);
}

TEST_F(Shapes, LinkWhoseMeshIsMissingIsDrawnAsItCollides) {
  const std::string gone = "<mesh filename=\"/gone/b.stl\"/>";
  const RobotDescription robot =
      Make({{trunk_visual_, gone}, {"<box size=\"0.3 0.1 0.03\"/>", gone}});
  const std::vector<Shape> trunk = Of(robot.visuals, "base_link");
  ASSERT_EQ(trunk.size(), 1u) << "though the head, on the same body, has its own";
  EXPECT_EQ(trunk[0].size_m, Vec3(0.3762, 0.0935, 0.114));
  EXPECT_EQ(fmt::format("{}", fmt::join(FindSuspicions(robot), "; ")),
            "base_link: visual mesh /gone/b.stl is missing; the link is drawn as it collides");
  const RobotDescription half = Make({{trunk_visual_, gone}});
  EXPECT_EQ(Of(half.visuals, "base_link").size(), 1u);
  EXPECT_EQ(fmt::format("{}", fmt::join(FindSuspicions(half), "; ")),
            "base_link: visual mesh /gone/b.stl is missing and not drawn");
}

TEST_F(Shapes, MeshesKeepTheColoursOfTheirFiles) {
  WriteMesh("plain.obj", {0, 0, 0}, {1, 1, 1});
  WriteText(File("c.mtl"), "newmtl red\nKd 0.9 0.1 0.2\nnewmtl wood\nKd 1 1 1\nmap_Kd wood.png\n");
  WriteText(File("c.obj"),
            "mtllib c.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl red\nf 1/1 2/1 3/1\n"
            "usemtl wood\nf 3/1 2/1 1/1\n");
  const auto plain = LoadMesh(File("plain.obj"), Vec3::Ones());
  ASSERT_TRUE(plain.has_value());
  ASSERT_EQ(plain->parts.size(), 1u);
  EXPECT_FALSE(plain->parts[0].colour.has_value()) << "the URDF's colour it is";
  EXPECT_EQ(plain->parts[0].num_points, plain->points.size());
  const auto coloured = LoadMesh(File("c.obj"), Vec3::Ones());
  ASSERT_TRUE(coloured.has_value());
  ASSERT_EQ(coloured->parts.size(), 2u);
  EXPECT_EQ(coloured->parts[0].colour, (std::array{0.9f, 0.1f, 0.2f}));
  EXPECT_TRUE(coloured->parts[0].texture.empty());
  EXPECT_EQ(coloured->parts[1].texture, folder_.path() / "wood.png");
}

}  // namespace
}  // namespace scoria::core
