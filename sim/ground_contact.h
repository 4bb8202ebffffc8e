// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "terrains/heightfield.h"

class btCollisionDispatcher;

namespace scoria::sim {

/// How bodies meet the ground. Spheres (feet) get one contact with the bicubic surface: Bullet's
/// own test kicks a sliding foot by tens of newtons at every internal triangle edge. Its contact
/// point carries the sphere's user pointer. Boxes and capsules (trunk, thighs, shanks) use Bullet's
/// triangles, behind a cheap test that they are near the ground at all. Keep alive as long as the
/// dispatcher.
class GroundContact {
 public:
  GroundContact(btCollisionDispatcher& dispatcher, const terrains::Heightfield& ground);
  ~GroundContact();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::sim
