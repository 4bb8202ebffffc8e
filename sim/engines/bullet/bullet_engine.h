// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "core/robot/description.h"
#include "sim/plant/engine.h"

namespace scoria::sim {

/// Bullet's own dynamics: the articulated-body algorithm of btMultiBody, its sequential-impulse
/// solver on contacts with a cone of friction, and its integrator. Of scoria's are the places of
/// the contacts with the springs and dampers of the ground, and the rows of what acts in a joint,
/// which Bullet lacks.
class BulletEngine final : public Engine {
 public:
  /// `robot` is borrowed.
  BulletEngine(const core::RobotDescription& robot, const Vec3& gravity_W,
               const SolverParams& params);
  ~BulletEngine() override;

  /// @pre no contact has a shear spring or a slack depth: the ground is elastic.
  [[nodiscard]] StepResult Step(const StepInput& in, std::span<ContactPoint> contacts) override;
  void Reset() noexcept override;
  [[nodiscard]] std::unique_ptr<Engine> Clone() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace scoria::sim
