// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/terrain/ground_colour.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scoria::analysis {

namespace {

struct Rgb {
  double r, g, b;
};
constexpr Rgb kRock = {0.23, 0.24, 0.27};
constexpr std::array<Rgb, 6> kColours = {{{0.71, 0.65, 0.59},
                                          {0.80, 0.51, 0.24},
                                          {0.88, 0.78, 0.43},
                                          {0.35, 0.67, 0.59},
                                          {0.63, 0.47, 0.67},
                                          {0.59, 0.75, 0.47}}};

}  // namespace

Vec3 MaterialColour(const terrains::Heightfield& ground, std::size_t index) {
  const bool rock = index > 0 && ground.covers()[index - 1].material.name == "rock";
  const Rgb& c = rock ? kRock : kColours[index % kColours.size()];
  return {c.r, c.g, c.b};
}

Vec3 GroundColour(const terrains::Heightfield& ground, const Vec2& p_W) {
  const double last = ground.nodes() - 1.0;
  const auto node = [&](double coordinate_m) {
    return static_cast<std::size_t>(std::lround(
        std::clamp((coordinate_m + ground.half_size_m()) / ground.resolution_m(), 0.0, last)));
  };
  const std::size_t at = node(p_W.y()) * static_cast<std::size_t>(ground.nodes()) + node(p_W.x());
  const Vec3 substrate = MaterialColour(ground, 0);
  Vec3 colour = substrate;
  for (std::size_t i = 0; i < ground.covers().size(); ++i)
    colour += ground.covers()[i].share[at] / 255.0 * (MaterialColour(ground, i + 1) - substrate);
  return colour;
}

}  // namespace scoria::analysis
