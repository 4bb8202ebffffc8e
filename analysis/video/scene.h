// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/robot/description.h"
#include "terrains/heightfield.h"

namespace scoria::analysis {

using Colour = std::array<float, 3>;

/// A straight stick between two points of W, for forces.
struct Stick {
  Vec3 from_W, to_W;
  double radius_m;
  Colour colour;
};

/// A ball, for footholds and the path walked.
struct Ball {
  Vec3 p_W;
  double radius_m;
  Colour colour;
};

/// What one frame shows.
struct Frame {
  Vec3 p_WB = Vec3::Zero();
  Mat3 R_WB = Mat3::Identity();
  LegArray<Vec3> q = ZeroPerLeg();
  std::vector<Stick> sticks;
  std::vector<Ball> balls;
  Vec3 eye_W = Vec3(-1.5, -1.5, 1.0);
  Vec3 look_at_W = Vec3::Zero();
};

/// Draws the robot from its description on the ground around it, without a screen.
class Scene {
 public:
  /// `robot` and `ground` are borrowed.
  Scene(const core::RobotDescription& robot, const terrains::Heightfield& ground, int width_px,
        int height_px);
  ~Scene();

  /// @returns pixels, rows top to bottom, blue green red alpha; valid until the next Draw.
  [[nodiscard]] const std::uint8_t* Draw(const Frame& frame);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::analysis
