// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "terrains/heightfield.h"

class btCollisionDispatcher;

namespace scoria::sim {

/// Replaces Bullet's sphere against heightfield test by one contact between the sphere and the
/// bicubic surface: the stock shape kicks a sliding foot by tens of newtons at every internal
/// triangle edge. Register before stepping; keep alive as long as the dispatcher.
class FootContact {
 public:
  FootContact(btCollisionDispatcher& dispatcher, const terrains::Heightfield& ground);
  ~FootContact();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::sim
