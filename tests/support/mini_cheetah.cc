// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/mini_cheetah.h"

#include <string>

#include <fmt/format.h>

#include "core/robot_files/load.h"

namespace scoria::test {
namespace {

constexpr double kThigh_m = 0.209, kShank_m = 0.195, kAbduction_m = 0.062;
constexpr double kHalfLength_m = 0.19, kHalfWidth_m = 0.049;
constexpr double kTrunkForward_m = 0.013,
                 kTrunkUp_m = 0.0057;  // of the hips' middle in the log's B
constexpr double kTrunk_kg = 3.3, kHip_kg = 0.54, kThigh_kg = 0.634, kShank_kg = 0.064;

std::string Link(const std::string& name, double mass_kg, double size_m, const std::string& rest) {
  const double inertia = mass_kg * size_m * size_m / 12.0;
  return fmt::format(
      "<link name=\"{0}\"><inertial><origin xyz=\"0 0 0\"/><mass value=\"{1}\"/><inertia "
      "ixx=\"{2}\" iyy=\"{2}\" izz=\"{2}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial>{3}</link>\n",
      name, mass_kg, inertia, rest);
}

std::string Joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& xyz, const std::string& rest) {
  return fmt::format(
      "<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/><origin "
      "xyz=\"{}\"/>{}</joint>\n",
      name, rest.empty() ? "fixed" : "revolute", parent, child, xyz, rest);
}

std::string Turning(const char* axis, double lower_rad, double upper_rad) {
  return fmt::format(
      "<axis xyz=\"{}\"/><limit lower=\"{}\" upper=\"{}\" effort=\"17\" velocity=\"40\"/>", axis,
      lower_rad, upper_rad);
}

std::string LegText(const std::string& leg, double end, double side) {
  const std::string ball = "<collision><geometry><sphere radius=\"0.015\"/></geometry></collision>";
  return Link(leg + "_abad", kHip_kg, 0.07, "") + Link(leg + "_thigh", kThigh_kg, 0.15, "") +
         Link(leg + "_shank", kShank_kg, 0.15, "") + Link(leg + "_foot", 0.001, 0.03, ball) +
         Joint(leg + "_abad_joint", "trunk", leg + "_abad",
               fmt::format("{} {} {}", kTrunkForward_m + end * kHalfLength_m, side * kHalfWidth_m,
                           kTrunkUp_m),
               Turning("1 0 0", -1.2, 1.2)) +
         Joint(leg + "_hip_joint", leg + "_abad", leg + "_thigh",
               fmt::format("0 {} 0", side * kAbduction_m), Turning("0 1 0", -3.2, 1.5)) +
         Joint(leg + "_knee_joint", leg + "_thigh", leg + "_shank",
               fmt::format("0 0 {}", -kThigh_m), Turning("0 1 0", 0.3, 2.7)) +
         Joint(leg + "_foot_fixed", leg + "_shank", leg + "_foot", fmt::format("0 0 {}", -kShank_m),
               "");
}

core::LegNames Names(const std::string& leg) {
  return {leg + "_abad_joint", leg + "_hip_joint", leg + "_knee_joint", leg + "_foot"};
}

}  // namespace

core::RobotDescription MakeMiniCheetah() {
  core::RobotConfig config;
  config.name = "mini_cheetah";
  config.legs = {Names("FL"), Names("FR"), Names("HL"), Names("HR")};
  config.has_foot_sensors = false;
  const std::string urdf = "<robot name=\"mini_cheetah\">\n" + Link("trunk", kTrunk_kg, 0.25, "") +
                           LegText("FL", 1.0, 1.0) + LegText("FR", 1.0, -1.0) +
                           LegText("HL", -1.0, 1.0) + LegText("HR", -1.0, -1.0) + "</robot>\n";
  return core::MakeRobot(config, urdf);
}

}  // namespace scoria::test
