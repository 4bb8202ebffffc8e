// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/robot/kinematics.h"
#include "sim/plant/contact_point.h"
#include "terrains/heightfield.h"

namespace scoria::sim {

/// Where the robot's bodies are at or near the ground, by Bullet's narrow phase. Each collision
/// shape meets the ground by an algorithm of its own that stays: there is no broad phase, whose
/// pairs would depend on the past and on addresses in memory. What one step leaves for the next is
/// the order of the shapes near the ground, and the points that Bullet caches of boxes and
/// capsules, up to four of each; those of spheres are found anew.
class ContactFinder {
 public:
  /// `robot` and `ground` are borrowed and must outlive the finder and its copies.
  ContactFinder(const core::RobotDescription& robot, const terrains::Heightfield& ground);
  ~ContactFinder();
  /// The copy goes on where the original is: the same bits from the same poses.
  ContactFinder(const ContactFinder& other);
  ContactFinder& operator=(const ContactFinder&) = delete;

  /// Replaces `contacts` by the points of bodies at `poses`; friction and springs are not filled.
  void Find(const std::array<core::LinkPose, core::kNumBodies>& poses, const Vec3& p_WB,
            std::vector<ContactPoint>& contacts);

  /// Forgets cached points.
  void Forget();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::sim
