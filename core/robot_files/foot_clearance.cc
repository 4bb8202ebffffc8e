// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/foot_clearance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/robot/kinematics.h"
#include "core/robot/normalise.h"
#include "core/robot/whole_body.h"
#include "core/robot_files/convex_hull.h"
#include "core/robot_files/shape_size.h"

namespace scoria::core {
namespace {

/// Level ground as a body sees it, in its link frame L: where down_L . p_L > offset_m.
struct GroundPlane {
  Vec3 down_L = -Vec3::UnitZ();
  double offset_m = 0.0;
};
using PlanesPerBody = std::array<std::vector<GroundPlane>, kNumBodies>;

/// Where a foot stands and swings, from its place in the neutral stance: the corners, edges and
/// middle of a box of stance travel, widening and swing height, in leg lengths.
std::vector<Vec3> FootOffsets(double leg_m) {
  constexpr double kTravel = 0.35, kAside = 0.1, kLift = 0.2;
  std::vector<Vec3> out;
  for (const double x : {-kTravel, 0.0, kTravel}) {
    for (const double y : {-kAside, 0.0, kAside}) {
      for (const double z : {0.0, kLift}) out.push_back(leg_m * Vec3(x, y, z));
    }
  }
  return out;
}

/// The ground in every pose: where a foot stands, or would stand if it were not lifted. Of the
/// trunk, where all feet stand.
PlanesPerBody FindGround(const RobotDescription& robot) {
  PlanesPerBody planes;
  const double height_m = robot.config.nominal_height_m, leg_m = LegLength(robot.legs[Leg::kFL]);
  for (const Leg leg : kLegs) {
    const LegDescription& l = robot.legs[leg];
    const Vec3 guess(0.0, -0.8 * l.knee_way, 1.6 * l.knee_way);
    const double above_m = 0.5 * l.foot_radius_m;  // half a radius over the ground
    planes[0].push_back({-Vec3::UnitZ(), height_m + above_m});
    for (const Vec3& offset : FootOffsets(leg_m)) {
      const Vec3 p_BF = robot.NeutralFoothold(leg) + offset - height_m * Vec3::UnitZ();
      LegArray<Vec3> q = ZeroPerLeg();
      q[leg] = SolveLegIk(l, p_BF, guess);
      const auto poses = CalcLinkPoses(robot, Vec3::Zero(), Mat3::Identity(), q);
      const LinkPose& shank = poses[static_cast<std::size_t>(BodyIndex(leg, Joint::kKFE))];
      const double foot_m = (shank.p_WL + shank.R_WL * l.p_LF).z() - offset.z();
      const double ground_m = foot_m - above_m;
      for (const Joint joint : {Joint::kHAA, Joint::kHFE, Joint::kKFE}) {
        const auto body = static_cast<std::size_t>(BodyIndex(leg, joint));
        const Vec3 down_L = -poses[body].R_WL.row(2).transpose();
        planes[body].push_back({down_L, poses[body].p_WL.z() - ground_m});
      }
    }
  }
  return planes;
}

/// Points that span a shape, in its frame G.
std::vector<Vec3> PointsOf(const Shape& shape) {
  const Vec3 half = 0.5 * ExtentOf(shape);
  std::vector<Vec3> out;
  if (shape.kind == Shape::Kind::kHull) return shape.hull;
  if (shape.kind == Shape::Kind::kBox) {
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 signs((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                       (corner & 4) != 0 ? 1 : -1);
      out.push_back(half.cwiseProduct(signs));
    }
    return out;
  }
  // Cylinders collide as capsules, so with their balls at either end.
  const double radius_m = shape.size_m[0];
  const double shift_m = std::max(0.0, half.z() - radius_m);
  constexpr int kSides = 12, kRings = 6;
  for (int ring = 0; ring < kRings; ++ring) {
    const double polar = std::numbers::pi * ring / (kRings - 1);
    const double z = radius_m * std::cos(polar) + std::copysign(shift_m, std::cos(polar));
    for (int side = 0; side < kSides; ++side) {
      const double azimuth = 2.0 * std::numbers::pi * side / kSides;
      const double r = radius_m * std::sin(polar);
      out.emplace_back(r * std::cos(azimuth), r * std::sin(azimuth), z);
    }
  }
  return out;
}

/// How far a shape reaches below the lowest plane, m.
double DepthBelow(const Shape& shape, const std::vector<Vec3>& points,
                  const std::vector<GroundPlane>& planes) {
  double depth_m = 0.0;
  for (const GroundPlane& plane : planes) {
    for (const Vec3& p : points) {
      const Vec3 p_L = shape.p_LG + shape.R_LG * p;
      depth_m = std::max(depth_m, plane.down_L.dot(p_L) - plane.offset_m);
    }
  }
  return depth_m;
}

/// What stays above every plane, as a hull; without points if that is nothing.
Shape Above(const Shape& shape, std::vector<Vec3> points, const std::vector<GroundPlane>& planes) {
  for (const GroundPlane& plane : planes) {
    const Vec3 down_G = shape.R_LG.transpose() * plane.down_L;
    points = CutHull(points, down_G, plane.offset_m - plane.down_L.dot(shape.p_LG));
  }
  Shape hull = shape;
  hull.kind = Shape::Kind::kHull;
  hull.hull.clear();
  constexpr double kThinnest_m = 1e-3;
  if (points.empty()) return hull;
  Vec3 low = points.front(), high = points.front();
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  hull.size_m = high - low;
  if (hull.size_m.minCoeff() < kThinnest_m) return hull;
  const Vec3 centre = 0.5 * (low + high);
  hull.p_LG = shape.p_LG + shape.R_LG * centre;
  for (const Vec3& p : points) hull.hull.push_back(p - centre);
  return hull;
}

/// What happened to shapes of one name, which mirrored links share.
struct Cut {
  std::vector<std::string> links;
  double depth_m = 0.0;
};
using Cuts = std::map<std::pair<std::string, bool>, Cut>;  // by name and whether anything is left

std::string Describe(const std::pair<std::string, bool>& name_and_left, const Cut& cut) {
  const auto& [name, is_left] = name_and_left;
  return fmt::format(
      "{}: {} comes within half a foot's radius of the ground, {:.0f} mm too low in standing or "
      "swing poses; {}",
      fmt::join(cut.links, ", "), name, 1e3 * cut.depth_m,
      is_left ? "what is too low is cut off" : "it is left out");
}

}  // namespace

void CutBelowFeet(RobotDescription& robot) {
  constexpr double kRounding_m = 1e-9;
  const PlanesPerBody planes = FindGround(robot);
  std::vector<Shape> kept;
  Cuts cuts;
  for (const Shape& shape : robot.collisions) {
    const auto& ground = planes[static_cast<std::size_t>(shape.body)];
    const std::vector<Vec3> points = PointsOf(shape);
    const double depth_m = shape.is_foot ? 0.0 : DepthBelow(shape, points, ground);
    if (depth_m <= kRounding_m) {
      kept.push_back(shape);
      continue;
    }
    const Shape above = Above(shape, points, ground);
    const std::string name =
        shape.mesh.empty() ? "its collision shape" : shape.mesh.filename().string();
    Cut& cut = cuts[{name, !above.hull.empty()}];
    cut.links.push_back(shape.link);
    cut.depth_m = std::max(cut.depth_m, depth_m);
    if (!above.hull.empty()) kept.push_back(above);
  }
  robot.collisions = std::move(kept);
  for (const auto& [name, cut] : cuts) robot.warnings.push_back(Describe(name, cut));
}

}  // namespace scoria::core
