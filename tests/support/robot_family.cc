// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/robot_family.h"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/files.h"
#include "core/math/so3.h"
#include "core/robot/legs.h"

namespace scoria::test {
namespace {

using core::RotationFromRpy;
using core::RpyFromRotation;

std::string Numbers(const Vec3& v) {
  return fmt::format("{:.12g} {:.12g} {:.12g}", v.x(), v.y(), v.z());
}

/// Masses, lengths and limits of the Go2's front left leg, joint by joint; shapes of its own.
struct LinkData {
  const char* name;
  double mass_kg;
  Vec3 p_LC;     // centre of mass
  Vec3 moments;  // about it, along the axes
  Vec3 p_PJ;     // of the joint in the parent
  Vec3 axis;
  double lower_rad, upper_rad, effort_Nm, velocity_radps;
};

const std::array<LinkData, 3>& LinksOfGo2() {
  static const std::array<LinkData, 3> kLinks = {{{"hip",
                                                   0.678,
                                                   {-0.0054, 0.00194, -0.000105},
                                                   {0.00048, 0.000884, 0.000596},
                                                   {0.1934, 0.0465, 0.0},
                                                   Vec3::UnitX(),
                                                   -1.0472,
                                                   1.0472,
                                                   23.7,
                                                   30.1},
                                                  {"thigh",
                                                   1.152,
                                                   {-0.00374, -0.0223, -0.0327},
                                                   {0.00584, 0.0058, 0.00103},
                                                   {0.0, 0.0955, 0.0},
                                                   Vec3::UnitY(),
                                                   -1.5708,
                                                   3.4907,
                                                   23.7,
                                                   30.1},
                                                  {"calf",
                                                   0.194,
                                                   {0.00548, -0.000975, -0.135},
                                                   {0.0014, 0.00145, 0.00004},
                                                   {0.0, 0.0, -0.213},
                                                   Vec3::UnitY(),
                                                   -2.7227,
                                                   -0.83776,
                                                   45.43,
                                                   15.7}}};
  return kLinks;
}
constexpr double kTrunk_kg = 6.923;
const Vec3 kTrunkMoments(0.02448, 0.098077, 0.107), kTrunkCentre(0.021112, 0.0, -0.005366);

/// The frame that a member's URDF uses for a leg's link, seen from the plain one.
Mat3 Turned(const FamilyMember& member, std::size_t joint) {
  if (!member.turned_frames) return Mat3::Identity();
  constexpr double kQuarter = 0.5 * std::numbers::pi;
  // z along the joint's axis.
  return joint == 0 ? RotationFromRpy({0.0, kQuarter, 0.0})
                    : RotationFromRpy({-kQuarter, 0.0, 0.0});
}

class Writer {
 public:
  explicit Writer(const FamilyMember& member) : m_(member) {
    double legs_kg = 0.0;
    for (const LinkData& link : LinksOfGo2()) legs_kg += kNumLegs * link.mass_kg;
    const double whole_kg = legs_kg + kTrunk_kg, share = legs_kg / whole_kg;
    leg_scale_ = m_.leg_mass_share.value_or(share) / share;
    trunk_scale_ = (1.0 - m_.leg_mass_share.value_or(share)) / (1.0 - share);
    whole_kg_ = m_.mass_scale * whole_kg;
  }

  std::string Urdf() {
    xml_ = fmt::format("<robot name=\"{}\">\n", m_.name);
    if (m_.root_away) {
      xml_ += "<link name=\"base_footprint\"/>\n";
      Joint("base_footprint_joint", "fixed", "base_footprint", "base_link",
            Length({-0.2, 0.1, 0.45}), RotationFromRpy({0.0, 0.0, 0.5 * std::numbers::pi}), "");
    }
    Link("base_link", trunk_scale_ * kTrunk_kg, kTrunkCentre, trunk_scale_ * kTrunkMoments,
         Mat3::Identity(), Box({0.3762, 0.0935, 0.114}, Vec3::Zero(), Mat3::Identity()));
    for (const Leg leg : kLegs) AddLeg(leg);
    if (m_.arm) Arm();
    return xml_ + "</robot>\n";
  }

 private:
  [[nodiscard]] Vec3 Length(const Vec3& p) const { return m_.length_scale * p; }

  void Link(const std::string& name, double mass, const Vec3& p_LC, const Vec3& moments,
            const Mat3& R_LN, const std::string& shapes) {
    const double s = m_.mass_scale, l = m_.length_scale;
    const Vec3 I = s * l * l * moments;
    xml_ += fmt::format(
        "<link name=\"{}\">\n<inertial><origin xyz=\"{}\" rpy=\"{}\"/><mass value=\"{:.12g}\"/>"
        "<inertia ixx=\"{:.12g}\" iyy=\"{:.12g}\" izz=\"{:.12g}\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/>"
        "</inertial>\n{}</link>\n",
        name, Numbers(R_LN.transpose() * Length(p_LC)), Numbers(RpyFromRotation(R_LN.transpose())),
        s * mass, I.x(), I.y(), I.z(), shapes);
  }

  static std::string Origin(const Vec3& p, const Mat3& R) {
    return fmt::format("<origin xyz=\"{}\" rpy=\"{}\"/>", Numbers(p), Numbers(RpyFromRotation(R)));
  }

  /// At p in the plain frame of a link whose own frame is turned by R_LN.
  std::string Box(const Vec3& size, const Vec3& p, const Mat3& R_LN) const {
    return fmt::format("<collision>{}<geometry><box size=\"{}\"/></geometry></collision>\n",
                       Origin(R_LN.transpose() * Length(p), R_LN.transpose()),
                       Numbers(Length(size)));
  }

  void Joint(const std::string& name, const std::string& type, const std::string& parent,
             const std::string& child, const Vec3& p, const Mat3& R, const std::string& rest) {
    xml_ += fmt::format(
        "<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/>{}{}</joint>\n",
        name, type, parent, child, Origin(p, R), rest);
  }

  [[nodiscard]] bool IsMirrored(Leg leg) const { return m_.mirrored_hind_legs && !IsFront(leg); }

  /// A vector of the front left leg, of another leg.
  [[nodiscard]] Vec3 OfLeg(const Vec3& v, Leg leg) const {
    return {(IsMirrored(leg) ? -1.0 : 1.0) * v.x(), (IsLeft(leg) ? 1.0 : -1.0) * v.y(), v.z()};
  }

  void AddLeg(Leg leg) {
    const std::string prefix = fmt::format("{}_", LegName(leg));
    for (std::size_t j = 0; j < 3; ++j) {
      const LinkData& d = LinksOfGo2()[j];
      const Mat3 R_LN = Turned(m_, j);
      const Mat3 R_PN = j == 0 ? Mat3::Identity() : Turned(m_, j - 1);
      Vec3 p_PJ = OfLeg(d.p_PJ, leg);
      if (j == 0) p_PJ.x() = (IsFront(leg) ? 1.0 : -1.0) * d.p_PJ.x();
      // A right leg's axes point the other way, and a turned knee's zero is at a bend.
      const double sign = m_.turned_frames && !IsLeft(leg) ? -1.0 : 1.0;
      const double zero_rad = m_.turned_frames && j == 2 ? -1.1 : 0.0;
      const Mat3 R_zero = Eigen::AngleAxisd(zero_rad, d.axis).toRotationMatrix();
      Joint(prefix + d.name + "_joint", "revolute",
            j == 0 ? "base_link" : prefix + LinksOfGo2()[j - 1].name, prefix + d.name,
            R_PN.transpose() * Length(p_PJ), R_PN.transpose() * R_zero * R_LN,
            Limits(d, leg, j, sign, zero_rad,
                   m_.turned_frames ? Vec3(sign * Vec3::UnitZ()) : d.axis));
      const Vec3 foot(0.0, 0.0, -0.213);
      const std::string shape = j == 0 ? "" : Box({0.03, 0.03, 0.1}, Vec3(0.0, 0.0, -0.08), R_LN);
      Link(prefix + d.name, leg_scale_ * d.mass_kg, OfLeg(d.p_LC, leg), leg_scale_ * d.moments,
           R_LN, shape);
      if (j == 2) Foot(prefix, R_LN.transpose() * Length(foot));
    }
  }

  void Foot(const std::string& prefix, const Vec3& p) {
    xml_ += fmt::format(
        "<link name=\"{}foot\"><collision><geometry><sphere radius=\"{:.12g}\"/></geometry>"
        "</collision></link>\n",
        prefix, 0.022 * m_.length_scale);
    Joint(prefix + "foot_joint", "fixed", prefix + "calf", prefix + "foot", p, Mat3::Identity(),
          "");
  }

  std::string Limits(const LinkData& d, Leg leg, std::size_t j, double sign, double zero_rad,
                     const Vec3& axis) const {
    double lower_rad = d.lower_rad, upper_rad = d.upper_rad;
    if (m_.mirrored_hind_legs && j == 2) {
      lower_rad = -2.7227;
      upper_rad = 2.7227;
    } else if (IsMirrored(leg) && j == 1) {
      lower_rad = -d.upper_rad;
      upper_rad = -d.lower_rad;
    }
    const double a = sign * (lower_rad - zero_rad), b = sign * (upper_rad - zero_rad);
    return fmt::format(
        "<axis xyz=\"{}\"/><limit lower=\"{:.12g}\" upper=\"{:.12g}\" effort=\"{:.12g}\" "
        "velocity=\"{:.12g}\"/>",
        Numbers(axis), std::min(a, b), std::max(a, b),
        m_.mass_scale * m_.length_scale * d.effort_Nm,
        d.velocity_radps / std::sqrt(m_.length_scale));
  }

  /// Shoulder, upper arm, forearm; the elbow cannot reach zero.
  void Arm() {
    const std::array<Vec3, 3> places = {{{0.1, 0.0, 0.06}, {0.0, 0.0, 0.05}, {-0.2, 0.0, 0.0}}};
    const std::array<std::pair<double, double>, 3> limits = {{{-3.0, 3.0}, {0.0, 2.9}, {0.2, 3.0}}};
    std::string parent = "base_link";
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string name = fmt::format("arm_{}", i + 1);
      const Vec3 axis = i == 0 ? Vec3(Vec3::UnitZ()) : Vec3(Vec3::UnitY());
      Joint(name + "_joint", "revolute", parent, name, Length(places[i]), Mat3::Identity(),
            fmt::format("<axis xyz=\"{}\"/><limit lower=\"{}\" upper=\"{}\" effort=\"30\" "
                        "velocity=\"3\"/>",
                        Numbers(axis), limits[i].first, limits[i].second));
      const double mass = whole_kg_ / m_.mass_scale / 30.0;
      Link(name, mass, {-0.05, 0.0, 0.0}, mass * Vec3(0.001, 0.004, 0.004), Mat3::Identity(), "");
      parent = name;
    }
  }

  const FamilyMember& m_;
  std::string xml_;
  double leg_scale_ = 1.0, trunk_scale_ = 1.0, whole_kg_ = 0.0;
};

std::string Yaml(const FamilyMember& member) {
  std::string yaml = fmt::format("name: {0}\nurdf: {0}.urdf\nlegs:\n", member.name);
  for (const Leg leg : kLegs) {
    yaml += fmt::format(
        "  {0}: {{haa: {0}_hip_joint, hfe: {0}_thigh_joint, kfe: {0}_calf_joint, foot: "
        "{0}_foot}}\n",
        LegName(leg));
  }
  if (member.unscaled_motors) return yaml;
  const double s = member.mass_scale, l = member.length_scale;
  const auto list = [](double v) { return fmt::format("[{0:.12g}, {0:.12g}, {0:.12g}]", v); };
  return yaml +
         fmt::format("motors: {{armature_kgm2: {}, damping_Nms_per_rad: {}, friction_Nm: {}}}\n",
                     list(0.01 * s * l * l), list(0.1 * s * std::pow(l, 1.5)), list(0.2 * s * l));
}

}  // namespace

std::vector<FamilyMember> RobotFamily() {
  return {
      {.name = "plain"},
      {.name = "similar_small", .mass_scale = 0.15, .length_scale = 0.53},
      {.name = "similar_large", .mass_scale = 6.0, .length_scale = 1.8},
      {.name = "light_on_long_legs", .mass_scale = 0.4, .length_scale = 1.35},
      {.name = "heavy_on_short_legs", .mass_scale = 2.66, .length_scale = 0.9},
      {.name = "light_legs", .leg_mass_share = 0.1},
      {.name = "heavy_legs", .leg_mass_share = 0.6},
      {.name = "mirrored_hind_legs", .mirrored_hind_legs = true},
      {.name = "turned_frames", .turned_frames = true},
      {.name = "root_away", .root_away = true},
      {.name = "unscaled_motors", .mass_scale = 6.0, .length_scale = 1.8, .unscaled_motors = true},
      {.name = "arm", .arm = true}};
}

std::string FamilyUrdf(const FamilyMember& member) { return Writer(member).Urdf(); }

std::filesystem::path WriteFamilyRobot(const FamilyMember& member,
                                       const std::filesystem::path& folder) {
  core::WriteText(folder / (member.name + ".urdf"), FamilyUrdf(member));
  const std::filesystem::path yaml = folder / (member.name + ".yaml");
  core::WriteText(yaml, Yaml(member));
  return yaml;
}

}  // namespace scoria::test
