// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/convex_hull.h"

#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace scoria::core {
namespace {

/// Both ways of the axes, and a Fibonacci lattice on the sphere: points at equal steps of height,
/// each turned by the golden angle against the one before.
std::array<Vec3, kMaxHullPoints> Directions() {
  std::array<Vec3, kMaxHullPoints> out;
  constexpr std::size_t kAxes = 6, kSpread = kMaxHullPoints - kAxes;
  for (std::size_t i = 0; i < kAxes; ++i) {
    out[i] = (i % 2 == 0 ? 1.0 : -1.0) * Vec3::Unit(static_cast<Eigen::Index>(i / 2));
  }
  const double golden_rad = 2.0 * std::numbers::pi * (1.0 - 1.0 / std::numbers::phi);
  for (std::size_t i = 0; i < kSpread; ++i) {
    const double n = static_cast<double>(i), z = 1.0 - (2.0 * n + 1.0) / kSpread,
                 r = std::sqrt(1.0 - z * z);
    out[kAxes + i] = Vec3(r * std::cos(golden_rad * n), r * std::sin(golden_rad * n), z);
  }
  return out;
}

}  // namespace

std::vector<Vec3> ReduceToHull(const std::vector<Vec3>& points) {
  std::set<std::size_t> kept;
  for (const Vec3& direction : Directions()) {
    std::size_t farthest = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (direction.dot(points[i]) > direction.dot(points[farthest])) farthest = i;
    }
    if (!points.empty()) kept.insert(farthest);
  }
  std::vector<Vec3> out;
  for (const std::size_t i : kept) out.push_back(points[i]);
  return out;
}

std::vector<Vec3> CutHull(const std::vector<Vec3>& points, const Vec3& normal, double offset_m) {
  std::vector<Vec3> inside, outside;
  for (const Vec3& p : points) (normal.dot(p) <= offset_m ? inside : outside).push_back(p);
  std::vector<Vec3> out = inside;
  for (const Vec3& a : inside) {
    for (const Vec3& b : outside) {
      const double t = (offset_m - normal.dot(a)) / normal.dot(b - a);
      out.push_back(a + t * (b - a));
    }
  }
  return out.size() > kMaxHullPoints ? ReduceToHull(out) : out;
}

}  // namespace scoria::core
