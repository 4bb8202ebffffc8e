// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "terrains/heightfield.h"

class btCollisionDispatcher;

namespace scoria::sim {

/// The ground as GroundContact sees it; never changes.
struct GroundShape;

/// `ground` is borrowed. Takes a while for a large ground; shared by the copies of a plant, which
/// may end in any order.
[[nodiscard]] std::shared_ptr<const GroundShape> MakeGroundShape(
    const terrains::Heightfield& ground);

/// How bodies meet the ground. Spheres (feet) get one contact with the bicubic surface: Bullet's
/// own test kicks a sliding foot by tens of newtons at every internal triangle edge. Boxes and
/// capsules (trunk, thighs, shanks) use Bullet's triangles, behind a cheap test that they are near
/// the ground at all. Keep alive as long as the dispatcher.
class GroundContact {
 public:
  GroundContact(btCollisionDispatcher& dispatcher, std::shared_ptr<const GroundShape> shape);
  ~GroundContact();
  GroundContact(const GroundContact&) = delete;
  GroundContact& operator=(const GroundContact&) = delete;

  [[nodiscard]] const std::shared_ptr<const GroundShape>& shape() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::sim
