// SPDX-License-Identifier: BSD-3-Clause
#include "terrains/heightfield.h"

#include <algorithm>
#include <cmath>

#include "core/demand.h"

namespace scoria::terrains {
namespace {

/// Catmull-Rom weights of the four nodes around t in [0, 1], and their derivatives.
struct Weights {
  double w[4], d[4];
  explicit Weights(double t) noexcept
      : w{t * (t * (-0.5 * t + 1.0) - 0.5), t * t * (1.5 * t - 2.5) + 1.0,
          t * (t * (-1.5 * t + 2.0) + 0.5), t * t * (0.5 * t - 0.5)},
        d{t * (-1.5 * t + 2.0) - 0.5, t * (4.5 * t - 5.0), t * (-4.5 * t + 4.0) + 0.5,
          t * (1.5 * t - 1.0)} {}
};

}  // namespace

Heightfield::Heightfield(int nodes, double resolution_m, std::vector<double> heights_m,
                         Material substrate, std::vector<Cover> covers)
    : nodes_(nodes),
      resolution_m_(resolution_m),
      heights_m_(std::move(heights_m)),
      substrate_(std::move(substrate)),
      covers_(std::move(covers)) {
  const auto size = static_cast<std::size_t>(nodes) * static_cast<std::size_t>(nodes);
  SCORIA_DEMAND(nodes >= 2 && heights_m_.size() == size, "nodes {}, heights {}", nodes,
                heights_m_.size());
  for (const Cover& cover : covers_) {
    SCORIA_DEMAND(cover.share.size() == size, "{}: {} shares", cover.material.name,
                  cover.share.size());
  }
  const auto [low, high] = std::minmax_element(heights_m_.begin(), heights_m_.end());
  min_m_ = *low;
  max_m_ = *high;
  SCORIA_DEMAND(std::isfinite(min_m_) && std::isfinite(max_m_), "heights from {} to {}", min_m_,
                max_m_);
}

double Heightfield::NodeHeight(int column, int row) const noexcept {
  const auto c = static_cast<std::size_t>(std::clamp(column, 0, nodes_ - 1));
  const auto r = static_cast<std::size_t>(std::clamp(row, 0, nodes_ - 1));
  return heights_m_[r * static_cast<std::size_t>(nodes_) + c];
}

Vec2 Heightfield::NodePosition(int column, int row) const noexcept {
  return {column * resolution_m_ - half_size_m(), row * resolution_m_ - half_size_m()};
}

Heightfield::Sample Heightfield::At(double x_m, double y_m) const noexcept {
  const double limit = nodes_ - 1.0;
  const double u = std::clamp((x_m + half_size_m()) / resolution_m_, 0.0, limit);
  const double v = std::clamp((y_m + half_size_m()) / resolution_m_, 0.0, limit);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const Weights wx(u - i), wy(v - j);
  Sample sample;
  const bool inside = i >= 1 && j >= 1 && i + 2 < nodes_ && j + 2 < nodes_;
  for (int b = 0; b < 4; ++b) {
    double row = 0.0, row_dx = 0.0;
    const double* node =
        inside ? heights_m_.data() + static_cast<std::ptrdiff_t>(j + b - 1) * nodes_ + i - 1
               : nullptr;
    for (int a = 0; a < 4; ++a) {
      const double z = inside ? node[a] : NodeHeight(i + a - 1, j + b - 1);
      row += wx.w[a] * z;
      row_dx += wx.d[a] * z;
    }
    sample.z_m += wy.w[b] * row;
    sample.gradient.x() += wy.w[b] * row_dx;
    sample.gradient.y() += wy.d[b] * row;
  }
  sample.gradient /= resolution_m_;
  const double reach_m = half_size_m();  // beyond it the border's height continues, level
  if (std::abs(x_m) > reach_m) sample.gradient.x() = 0.0;
  if (std::abs(y_m) > reach_m) sample.gradient.y() = 0.0;
  return sample;
}

GroundSample Heightfield::GroundAt(double x_m, double y_m) const noexcept {
  GroundSample ground{substrate_.friction, substrate_.stiffness_N_per_m3,
                      substrate_.stiffness_N_per_m3, 0.0, substrate_.damping_ratio};
  if (covers_.empty()) return ground;
  const double limit = nodes_ - 1.0;
  const double u = std::clamp((x_m + half_size_m()) / resolution_m_, 0.0, limit);
  const double v = std::clamp((y_m + half_size_m()) / resolution_m_, 0.0, limit);
  const int i = std::min(static_cast<int>(u), nodes_ - 2);
  const int j = std::min(static_cast<int>(v), nodes_ - 2);
  const double tx = u - i, ty = v - j;
  const auto size = static_cast<std::size_t>(nodes_);
  const std::size_t at = static_cast<std::size_t>(j) * size + static_cast<std::size_t>(i);
  double log_ratio = 0.0;  // of the layer's stiffness to the substrate's
  for (const auto& [material, share] : covers_) {
    const double part = ((1.0 - ty) * ((1.0 - tx) * share[at] + tx * share[at + 1]) +
                         ty * ((1.0 - tx) * share[at + size] + tx * share[at + size + 1])) /
                        255.0;
    if (part == 0.0) continue;
    ground.friction += part * (material.friction - substrate_.friction);
    ground.damping_ratio += part * (material.damping_ratio - substrate_.damping_ratio);
    ground.depth_m += part * material.depth_m;
    log_ratio += part * std::log(material.stiffness_N_per_m3 / substrate_.stiffness_N_per_m3);
  }
  ground.layer_N_per_m3 *= std::exp(log_ratio);
  return ground;
}

}  // namespace scoria::terrains
