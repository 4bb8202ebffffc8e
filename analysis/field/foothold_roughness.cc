// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/field/foothold_roughness.h"

#include <algorithm>
#include <cmath>
#include <span>

#include <Eigen/Cholesky>

namespace scoria::analysis {
namespace {

/// Sums over stretches.
struct Pairs {
  double sum_m2 = 0.0;
  std::uint64_t count = 0;

  void Add(std::span<const Vec3> footholds, double lag_m) {
    if (footholds.size() < 4) return;
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : footholds) mean += p / static_cast<double>(footholds.size());
    Eigen::Matrix2d A = 1e-6 * Eigen::Matrix2d::Identity();  // keeps a straight way solvable
    Vec2 b = Vec2::Zero();
    for (const Vec3& p : footholds) {
      const Vec2 d = (p - mean).head<2>();
      A += d * d.transpose();
      b += d * (p.z() - mean.z());
    }
    const Vec2 slope = A.ldlt().solve(b);
    for (std::size_t i = 0; i < footholds.size(); ++i) {
      const std::size_t end = std::min(footholds.size(), i + 1 + FootholdRoughness::kPairs);
      for (std::size_t j = i + 1; j < end; ++j) {
        const Vec3 d = footholds[j] - footholds[i];
        const double far_m = d.head<2>().norm();
        if (far_m < lag_m / FootholdRoughness::kTolerance ||
            far_m > lag_m * FootholdRoughness::kTolerance)
          continue;
        const double rise_m = d.z() - slope.dot(d.head<2>());
        sum_m2 += rise_m * rise_m;
        ++count;
      }
    }
  }
};

}  // namespace

std::vector<std::span<const Vec3>> FootholdRoughness::Stretches() const {
  std::vector<std::span<const Vec3>> stretches;
  const std::span<const Vec3> all(footholds_);
  std::size_t begin = 0;
  auto next_break = breaks_.begin();
  for (std::size_t i = 0; i <= all.size(); ++i) {
    bool ends = i == all.size();
    for (; next_break != breaks_.end() && *next_break == i; ++next_break) ends = true;
    ends = ends || (all[i] - all[begin]).head<2>().norm() > kStretch_m;
    if (!ends || i == begin) continue;
    stretches.push_back(all.subspan(begin, i - begin));
    begin = i;
  }
  return stretches;
}

std::optional<double> FootholdRoughness::Nu_m(double lag_m) const {
  constexpr std::uint64_t kLeast = 30;
  Pairs pairs;
  for (const std::span<const Vec3> stretch : Stretches()) pairs.Add(stretch, lag_m);
  if (pairs.count < kLeast) return std::nullopt;
  return std::sqrt(pairs.sum_m2 / static_cast<double>(pairs.count));
}

}  // namespace scoria::analysis
