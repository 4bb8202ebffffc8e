// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/math/types.h"

namespace scoria::sim {

/// A point at which the ground may push on a body during one step. Along the normal the ground is
/// a spring and a damper that can only push; along the surface it is Coulomb friction, behind a
/// shear spring where the ground yields before it slips.
struct ContactPoint {
  int body = 0;  // as core::BodyIndex, 0 the trunk
  bool is_foot = false;
  Vec3 p_BP_W = Vec3::Zero();  // from B's origin
  Vec3 n_W = Vec3::UnitZ();    // out of the ground
  double gap_m = 0.0;          // < 0 inside the ground
  double friction = 0.0;
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  double rest_m = 0.0;                   // penetration at which the spring is slack
  double shear_stiffness_N_per_m = 0.0;  // 0: rigid up to the friction limit
  Vec3 shear_W = Vec3::Zero();           // displacement of the shear spring, m
  Vec3 impulse_W = Vec3::Zero();         // N s on the robot; a guess before, the solution after
  Vec3 v_W = Vec3::Zero();               // of the point after the step
};

}  // namespace scoria::sim
