// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/math/types.h"

class btMultiBody;
class btMultiBodyConstraintSolver;

namespace scoria::sim {

/// What the solver needs to know of the joints' drives, owned by the world.
struct RotorDrives {
  btMultiBody* body = nullptr;
  Vec12 armature_kgm2 = Vec12::Zero();
  Vec12 damping_Nms_per_rad = Vec12::Zero();
  Vec12 qd_before_radps = Vec12::Zero();  // joint velocities at the start of the step
};

/// Bullet's multibody solver with rotor inertia A and viscous joint damping D, which Bullet lacks.
/// Both act as if the mass matrix were H + A + D dt: with G = H⁻¹E (E picks the joints) and the
/// Woodbury identity
///   (H + E S Eᵀ)⁻¹ = H⁻¹ − G S½ (1 + S½ EᵀG S½)⁻¹ S½ Gᵀ,   S = A + D dt,
/// the free velocity and the response of every contact row are corrected before the iterations, so
/// that no extra constraint rows are iterated and the result is exact.
[[nodiscard]] std::unique_ptr<btMultiBodyConstraintSolver> MakeRotorSolver(
    const RotorDrives& drives);

}  // namespace scoria::sim
